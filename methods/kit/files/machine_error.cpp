#include "methods/kit/files/machine_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "methods/contract/errors.h"

namespace dustbench::files {

MachineError::~MachineError() = default;

bool isOfMachine(int error) {
    static constexpr std::array ofMachine{ENOSPC, EDQUOT, EIO, EFBIG, EMFILE, ENFILE, ENOMEM};
    return std::ranges::find(ofMachine, error) != ofMachine.end();
}

bool isShortage(int error) {
    return isOfMachine(error) && error != EIO;
}

void failWriting(const std::filesystem::path& path, int error) {
    const std::string message =
        fmt::format("output '{}' cannot be written: {}", path.string(), std::generic_category().message(error));
    if (isOfMachine(error)) throw MachineError(message);
    throw InputError(message);
}

}  // namespace dustbench::files
