#include "bench/export/vtk_file.h"

#include <vtkCallbackCommand.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkXMLWriter.h>

#include <algorithm>
#include <cerrno>
#include <string>

#include "bench/export/whole_file.h"
#include "bench/measure/provenance.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::exports {
namespace {

void addTexts(vtkDataObject& data, const char* name, std::span<const std::string> texts) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& text : texts) array->InsertNextValue(text);
    data.GetFieldData()->AddArray(array);
}

}  // namespace

void writeVtk(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file, Numbers numbers) {
    std::string complaint;
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(&complaint);
    listener->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
        auto& first = *static_cast<std::string*>(client);
        if (first.empty() && text) first = static_cast<const char*>(text);
    });
    writer.AddObserver("ErrorEvent", listener);
    writer.GetExecutive()->AddObserver("ErrorEvent", listener);
    writer.SetFileName(file.c_str());
    writer.SetInputDataObject(&data);
    writer.SetCompressorTypeToLZ4();
    writer.SetHeaderTypeToUInt64();
    numbers == Numbers::appended ? writer.SetDataModeToAppended() : writer.SetDataModeToBinary();
    writer.EncodeAppendedDataOff();
    const int written = writer.Write();
    if (written != 0 && writer.GetErrorCode() == vtkErrorCode::NoError && complaint.empty()) return;
    const auto code = writer.GetErrorCode();  // an errno, or one of VTK's own
    if (code == vtkErrorCode::OutOfDiskSpaceError) files::failWriting(file, ENOSPC);
    if (code < vtkErrorCode::FirstVTKErrorCode && files::isOfMachine(static_cast<int>(code)))
        files::failWriting(file, static_cast<int>(code));
    if (code != vtkErrorCode::NoError) complaint = vtkErrorCode::GetStringFromErrorCode(code);
    std::ranges::replace(complaint, '\n', ' ');
    throw cannotWrite(file, complaint.empty() ? "VTK's writer failed" : complaint);
}

void addUnit(vtkDataObject& data, const std::string& array, const std::string& unit) {
    addTexts(data, (array + "_unit").c_str(), {&unit, 1});
}

void stampTime(vtkDataObject& data, double timeSeconds) {
    vtkNew<vtkDoubleArray> time;
    time->SetName("TimeValue");
    time->InsertNextValue(timeSeconds);
    data.GetFieldData()->AddArray(time);
}

void stampOrigin(vtkDataObject& data, const FileOrigin& origin) {
    stampTime(data, origin.timeSeconds);
    if (origin.method.empty()) return;
    const std::string method(origin.method), version = measure::buildFacts().version;
    addTexts(data, "method", {&method, 1});
    addTexts(data, "configuration", origin.configuration);
    addTexts(data, "dustbench_version", {&version, 1});
}

}  // namespace dustbench::exports
