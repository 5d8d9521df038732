#include "methods/kit/pictures/picture_library.h"

#include <dlfcn.h>

#include <stdexcept>

namespace dustbench::pictures {
namespace {

/// Never unloaded, because OpenImageIO starts its own threads.
const PictureLibrary& load() {
    const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "libdustbench_pictures.so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* function = library == nullptr ? nullptr : dlsym(library, "dustbenchPictureLibrary");
    if (function == nullptr) {
        const char* reason = dlerror();
        throw std::runtime_error("cannot load the library for pictures: " +
                                 (reason == nullptr ? file.string() : std::string(reason)));
    }
    return *reinterpret_cast<const PictureLibrary* (*)()>(function)();
}

}  // namespace

const PictureLibrary& pictureLibrary() {
    static const PictureLibrary& library = load();
    return library;
}

}  // namespace dustbench::pictures
