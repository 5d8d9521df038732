// Common settings of all VTK files: lz4 compression, and VTK errors reported as exceptions.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

class vtkDataObject;  // NOLINT(cppcoreguidelines-virtual-class-destructor): VTK's
class vtkXMLWriter;   // NOLINT(cppcoreguidelines-virtual-class-destructor): VTK's

namespace dustbench::exports {

/// Where the data is stored: appended after the XML as raw bytes, which is fastest, or inside it as base64.
enum class Numbers { appended, within };

/// Makes the writer write `data` to exactly `file`, which need not be the final place. Throws InputError with VTK's
/// error message on failure, files::MachineError on a full disk.
void writeVtk(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file,
              Numbers numbers = Numbers::appended);

/// Stores the unit of an array as field data `<array>_unit`, a text; `1` is a number without a unit.
void addUnit(vtkDataObject& data, const std::string& array, const std::string& unit);

/// What a file shows.
struct FileOrigin {
    FileOrigin(double seconds, std::string_view id = {},  // NOLINT(google-explicit-constructor): a time may be all
               std::span<const std::string> settings = {})
        : timeSeconds(seconds), method(id), configuration(settings) {}

    double timeSeconds;
    std::string_view method;                     ///< its id; may be empty
    std::span<const std::string> configuration;  ///< `name=value` each
};

/// Stores the simulation time of a single file where ParaView and PyVista look for it: field data `TimeValue`.
void stampTime(vtkDataObject& data, double timeSeconds);
/// Stores also the texts `method`, `configuration` (one value per setting) and `dustbench_version` if there is a
/// method.
void stampOrigin(vtkDataObject& data, const FileOrigin& origin);

}  // namespace dustbench::exports
