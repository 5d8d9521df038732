// Tests that files written by VTK's own writer are read as VTK wrote them.
#include "methods/kit/volumes/vtp_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::volumes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int cloudPoints = 7;

vtkNew<vtkPolyData> cloud() {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkDoubleArray> radius;
    vtkNew<vtkIntArray> id;
    vtkNew<vtkFloatArray> velocity, spread;
    velocity->SetNumberOfComponents(3);
    radius->SetName("R");
    id->SetName("id");
    velocity->SetName("velocity");
    for (vtkIdType i = 0; i < cloudPoints; ++i) {
        points->InsertNextPoint(0.5 * static_cast<double>(i), 1, -2);
        vertices->InsertNextCell(1, &i);
        radius->InsertNextValue(0.1 * static_cast<double>(i + 1));
        id->InsertNextValue(static_cast<int>(100 - i));
        velocity->InsertNextTuple3(1, 2, static_cast<double>(i));
    }
    data->SetPoints(points);
    data->SetVerts(vertices);
    data->GetPointData()->AddArray(radius);
    data->GetPointData()->AddArray(id);
    data->GetPointData()->SetVectors(velocity);
    vtkNew<vtkDoubleArray> time;
    time->SetName("TimeValue");
    time->InsertNextValue(2.25);
    data->GetFieldData()->AddArray(time);
    vtkNew<vtkStringArray> note;
    note->SetName("note");
    note->InsertNextValue("any text");
    data->GetFieldData()->AddArray(note);
    return data;
}

PointTable readCloud(const std::filesystem::path& file) {
    return readVtp(file, [](std::string_view) { return true; });
}

TEST(VtpFile, ReadsWhatVtkWritesInEveryForm) {
    const TestFolder folder;
    const auto file = folder.path() / "cloud.vtp";
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4})
            for (const bool base64 : {false, true}) {
                const auto data = cloud();
                vtkNew<vtkXMLPolyDataWriter> writer;
                writer->SetFileName(file.c_str());
                writer->SetInputData(data);
                writer->SetDataMode(mode);
                writer->SetCompressorType(compressor);
                writer->SetEncodeAppendedData(base64);
                ASSERT_EQ(writer->Write(), 1);
                const PointTable table = readCloud(file);
                ASSERT_EQ(table.points, 7u);
                EXPECT_EQ(table.timeSeconds, 2.25);
                EXPECT_THAT(table.find("id")->values, ElementsAre(100, 99, 98, 97, 96, 95, 94));
                EXPECT_DOUBLE_EQ(table.find("R")->values[2], 0.1 * 3);
                EXPECT_EQ(table.find("velocity")->components, 3);
                EXPECT_EQ(table.find("velocity")->values[20], 6);
                EXPECT_EQ(table.find(pointsColumn)->values[3], 0.5);
                EXPECT_EQ(table.find("note"), nullptr);
            }
}

TEST(VtpFile, KeepsOnlyTheNamesOfColumnsThatNobodyWants) {
    const TestFolder folder;
    const auto file = folder.path() / "cloud.vtp";
    const auto data = cloud();
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(data);
    writer->Write();
    const PointTable table = readVtp(file, [](std::string_view name) { return name == "R"; });
    EXPECT_TRUE(table.find("id")->values.empty());
    EXPECT_EQ(table.find("R")->values.size(), 7u);
}

TEST(VtpFile, EveryCutIsRefused) {
    const TestFolder folder;
    const auto file = folder.path() / "cloud.vtp";
    const auto data = cloud();
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(data);
    writer->EncodeAppendedDataOff();
    writer->Write();
    std::ifstream stream(file, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(stream), {});
    // Its last byte ends a line after the root.
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
        folder.write("cut.vtp", whole.substr(0, length));
        EXPECT_THAT(inputError([&] { (void)readCloud(folder.path() / "cut.vtp"); }), HasSubstr("cut.vtp: "));
        if (HasFailure()) break;
    }
}

TEST(VtpFile, WhatIsNoPolyDataOrLiesAboutItsLengthIsRefused) {
    const TestFolder folder;
    const auto refusal = [&](const std::string& text) {
        const auto file = folder.write("a.vtp", text);
        return inputError([&] { (void)readCloud(file); });
    };
    const auto with = [](const std::string& piece) {
        return "<VTKFile type=\"PolyData\"><PolyData>" + piece + "</PolyData></VTKFile>";
    };
    const std::string points =
        "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\">1 2 3</DataArray></Points>";
    EXPECT_THAT(refusal("<VTKFile type=\"ImageData\"/>"), HasSubstr("it is not poly data"));
    EXPECT_THAT(refusal(with("<Piece NumberOfPoints=\"99999999999\"/>")), HasSubstr("NumberOfPoints"));
    EXPECT_THAT(refusal(with("<Piece NumberOfPoints=\"9999999\"/>")), HasSubstr("do not fit into its"));
    EXPECT_THAT(refusal(with("<Piece NumberOfPoints=\"2\">" + points + "</Piece>")), HasSubstr("shorter"));
    EXPECT_THAT(refusal(with("<Piece NumberOfPoints=\"1\"/>")), HasSubstr("it has no points"));
    EXPECT_THAT(refusal(with("<Piece NumberOfPoints=\"1\">" + points + "</Piece><Piece NumberOfPoints=\"1\"/>")),
                HasSubstr("unexpected element"));
    EXPECT_EQ(readCloud(folder.write("b.vtp", with("<Piece NumberOfPoints=\"1\">" + points + "</Piece>"))).points, 1u);
}

}  // namespace
}  // namespace dustbench::volumes
