#include "methods/kit/files/loaded_library.h"

#include <dlfcn.h>
#include <link.h>

#include <stdexcept>

namespace dustbench::files {
namespace fs = std::filesystem;
namespace {

/// Path of the library or the program that contains this code.
fs::path ownFile() {
    Dl_info info{};
    void* loaded = nullptr;
    if (dladdr1(reinterpret_cast<const void*>(&ownFile), &info, &loaded, RTLD_DL_LINKMAP) == 0)
        throw std::runtime_error("the folder of dustbench's libraries was not found");
    const std::string name = static_cast<const link_map*>(loaded)->l_name;
    return name.empty() ? fs::read_symlink("/proc/self/exe") : fs::canonical(name);  // the program's name is empty
}

}  // namespace

fs::path inKitFolder(const std::string& name) {
    return ownFile().parent_path() / name;
}

void* functionOf(const std::string& name, const std::string& function, const std::string& what) {
    const fs::path file = inKitFolder("lib" + name + ".so");
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* address = library == nullptr ? nullptr : dlsym(library, function.c_str());
    if (address == nullptr) {
        const char* reason = dlerror();
        throw std::runtime_error("the library for " + what +
                                 " cannot be loaded: " + (reason == nullptr ? file.string() : std::string(reason)));
    }
    return address;
}

}  // namespace dustbench::files
