#include "methods/kit/particles/sprite_picture.h"

#include "methods/kit/files/data_folder.h"

namespace dustbench::particles {
namespace {

constexpr const char* gaussian = "gaussian";

}  // namespace

void declarePicture(ParameterSet& set) {
    std::vector<std::string> names = files::listData("textures", ".png");
    names.insert(names.begin(), gaussian);
    set.dataFile("picture", gaussian, "textures", ".png", names, "picture of a sprite; a strip contains several");
}

std::string pictureOf(const ParameterValues& values) {
    const std::string& name = values.choice("picture");
    return name == gaussian ? std::string() : name;
}

}  // namespace dustbench::particles
