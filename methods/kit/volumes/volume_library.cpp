#include "methods/kit/volumes/volume_library.h"

#include "methods/kit/files/loaded_library.h"

namespace dustbench::volumes {

const VolumeLibrary& volumeLibrary() {
    static const VolumeLibrary& library = *reinterpret_cast<const VolumeLibrary* (*)()>(
        files::functionOf("dustbench_volumes", "dustbenchVolumeLibrary", "volumes"))();
    return library;
}

}  // namespace dustbench::volumes
