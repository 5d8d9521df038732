// How all VTK files are written: compressed by lz4, and VTK's complaints become exceptions.
#pragma once

#include <filesystem>

class vtkDataObject;  // NOLINT(cppcoreguidelines-virtual-class-destructor): VTK's
class vtkXMLWriter;   // NOLINT(cppcoreguidelines-virtual-class-destructor): VTK's

namespace dustbench::bench {

/// Where the numbers lie: behind the XML as they are, which is quickest, or within it as base64.
enum class Numbers { appended, within };

/// Lets the writer write `data` to exactly `file`, which need not be the final place. Throws InputError with what VTK
/// complained of where it could not.
void writeVtk(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file,
              Numbers numbers = Numbers::appended);

/// The simulation's time in a file of its own, where ParaView and PyVista look for it: field data `TimeValue`.
void stampTime(vtkDataObject& data, double timeSeconds);

}  // namespace dustbench::bench
