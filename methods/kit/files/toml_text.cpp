#include "methods/kit/files/toml_text.h"

#include <fmt/format.h>

namespace dustbench::files {

std::string tomlText(std::string_view text) {
    std::string result = "\"";
    for (const char letter : text) {
        if (letter == '"' || letter == '\\')
            result += {'\\', letter};
        else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
            result += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
        else
            result += letter;
    }
    return result + "\"";
}

}  // namespace dustbench::files
