// How all VTK files are written: compressed by lz4, raw data appended, whole or not at all; VTK's complaints become
// exceptions.
#pragma once

#include <filesystem>

class vtkDataObject;
class vtkXMLWriter;

namespace dustbench::bench {

/// Lets the writer write `data` to exactly `file`, which need not be the final place. Throws InputError with what VTK
/// complained of where it could not.
void writeVtk(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file);

/// The simulation's time in a file of its own, where ParaView and PyVista look for it: field data `TimeValue`.
void stampTime(vtkDataObject& data, double timeSeconds);

}  // namespace dustbench::bench
