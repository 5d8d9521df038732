#include "methods/kit/files/loaded_library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace dustbench::files {

void* functionOf(const std::string& name, const std::string& function, const std::string& what) {
    const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / ("lib" + name + ".so");
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* address = library == nullptr ? nullptr : dlsym(library, function.c_str());
    if (address == nullptr) {
        const char* reason = dlerror();
        throw std::runtime_error("cannot load the library for " + what + ": " +
                                 (reason == nullptr ? file.string() : std::string(reason)));
    }
    return address;
}

}  // namespace dustbench::files
