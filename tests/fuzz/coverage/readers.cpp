// Target for Clang's libFuzzer: our own readers of text, selected by DUSTBENCH_FUZZ_READER. A text must be read or
// refused with InputError; anything else is a finding.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/meshes/polygons.h"
#include "methods/kit/volumes/vti_file.h"

namespace dustbench::fuzz {
namespace {

using Reader = std::function<void(std::string_view)>;

void readToml(std::string_view text) {
    files::TomlReader reader = files::TomlReader::parseText(text, "fuzz");
    for (const std::string& key : reader.keys())
        if (reader.has(key)) (void)reader.where(key);
}

void readVti(std::string_view text) {
    const volumes::VtiFile file(std::string(text), "fuzz");
    for (const volumes::VtiArray& array : file.cellArrays()) (void)file.numbersOf(array);
    (void)file.fieldNumber("TimeValue");
}

const Reader& chosenReader() {
    static const std::map<std::string_view, Reader> readers{
        {"toml", readToml},
        {"csv", [](std::string_view text) { (void)files::CsvTable::parseText(text, "fuzz"); }},
        {"obj", [](std::string_view text) { (void)meshes::readObj(text, "fuzz"); }},
        {"ply", [](std::string_view text) { (void)meshes::readPly(text, "fuzz"); }},
        {"stl", [](std::string_view text) { (void)meshes::readStl(text, "fuzz"); }},
        {"vti", readVti}};
    const char* const name = std::getenv("DUSTBENCH_FUZZ_READER");
    const auto found = readers.find(name ? name : "");
    if (found == readers.end()) std::abort();
    return found->second;
}

}  // namespace
}  // namespace dustbench::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto& read = dustbench::fuzz::chosenReader();
    try {
        read({reinterpret_cast<const char*>(data), size});
    } catch (const dustbench::InputError&) {  // refused
    }
    return 0;
}

#ifdef DUSTBENCH_ALONE
/// Reads the given files.
int main(int count, char** names) {
    for (int n = 1; n < count; ++n) {
        std::ifstream file(names[n], std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    }
    return 0;
}
#endif
