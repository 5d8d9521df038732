#include "methods/kit/pictures/picture_library.h"

#include "methods/kit/files/loaded_library.h"

namespace dustbench::pictures {

const PictureLibrary& pictureLibrary() {
    // Never unloaded, because OpenImageIO starts its own threads.
    static const PictureLibrary& library = *reinterpret_cast<const PictureLibrary* (*)()>(
        files::functionOf("dustbench_pictures", "dustbenchPictureLibrary", "pictures"))();
    return library;
}

}  // namespace dustbench::pictures
