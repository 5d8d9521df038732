#include "tests/fuzz/nano_ball.h"

#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>

namespace dustbench::fuzz {

void writeNanoBall(const std::filesystem::path& file) {
    nanovdb::io::writeGrid(file, nanovdb::createFogVolumeSphere<float>(/*radius=*/0.5f, nanovdb::Vec3f(0),
                                                                       /*voxelSize=*/0.125));
}

}  // namespace dustbench::fuzz
