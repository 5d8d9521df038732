// A temporary folder.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::results {

/// Removed with all its contents on destruction. Throws InputError if it cannot be created.
class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "dustbench-XXXXXX").string();
        if (!mkdtemp(name.data())) throw InputError(name + ": cannot create a temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

}  // namespace dustbench::results
