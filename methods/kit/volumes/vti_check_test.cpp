#include "methods/kit/volumes/vti_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::volumes {
namespace {

using ::testing::HasSubstr;

const std::string image =
    R"(<?xml version="1.0"?>
<!-- two cells -->
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="0 2 0 1 0 1"><CellData>
<DataArray type="Float32" Name="velocity" NumberOfComponents="3" format="ascii">1 2 3 4 5 6
<InformationKey name="RANGE" location="vtkDataArray"><Value index="0">1</Value></InformationKey></DataArray>
</CellData></Piece></ImageData></VTKFile>
)";

std::string faultOf(const std::string& text) {
    const TestFolder folder;
    return vtiFault(folder.write("a.vti", text));
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = image;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(VtiCheck, TakesWhatVtkWrites) {
    EXPECT_EQ(faultOf(image), "");
    EXPECT_EQ(faultOf(with("format=\"ascii\">1 2 3 4 5 6", "format=\"appended\" offset=\"0\">")),
              "its appended data are missing or cut");
    std::string appended = with("format=\"ascii\">1 2 3 4 5 6", "format=\"appended\" offset=\"8\">");
    appended.replace(appended.find("</VTKFile>"), 10,
                     "<AppendedData encoding=\"raw\">\n _<>&\"0123456789\n</AppendedData></VTKFile>");
    EXPECT_EQ(faultOf(appended), "");
}

TEST(VtiCheck, RefusesArraysOfNothing) {
    EXPECT_EQ(faultOf(with("1 2 3 4 5 6", "")), "an array is empty");
    EXPECT_EQ(faultOf(with("1 2 3 4 5 6", " \n\t")), "an array is empty");
    EXPECT_EQ(faultOf(with("format=\"ascii\">1 2 3 4 5 6", "format=\"binary\">")), "an array is empty");
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfComponents=\"0\"")), HasSubstr("allowed: 1..64"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfComponents=\"-1\"")), HasSubstr("allowed: 1..64"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfTuples=\"99999999999\"")),
                HasSubstr("NumberOfTuples"));
    for (const char* type : {"", "type=\"float\"", "tyqe=\"Float32\"", "type=\"vtkIdType\""})
        EXPECT_THAT(faultOf(with("type=\"Float32\"", type)), HasSubstr("an array has the type '")) << type;
    EXPECT_THAT(faultOf(with("ascii", "ascii2")), HasSubstr("the format 'ascii2'"));
}

TEST(VtiCheck, RefusesExtentsThatDoNotFit) {
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"0 2000000000")), HasSubstr("ends before it begins"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2 0 1", "WholeExtent=\"0 200000 0 200000")),
                HasSubstr("allowed: 256000000"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"0 9000000")), HasSubstr("do not fit into its"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"3 2")), HasSubstr("ends before"));
    EXPECT_THAT(faultOf(with("Piece Extent=\"0 2", "Piece Extent=\"0 3")), HasSubstr("lies outside"));
    EXPECT_THAT(faultOf(with("Piece Extent=\"0 2", "Piece Extent=\"x 3")), HasSubstr("six integers"));
}

TEST(VtiCheck, RefusesOtherXml) {
    EXPECT_THAT(faultOf(""), HasSubstr("no image"));
    EXPECT_THAT(faultOf("no volume"), HasSubstr("no image"));
    EXPECT_THAT(faultOf(with("type=\"ImageData\"", "type=\"PolyData\"")), HasSubstr("no image data"));
    EXPECT_THAT(faultOf(with("<!-- two cells -->", "<!DOCTYPE a [<!ENTITY a \"b\">]>")), HasSubstr("document type"));
    for (std::size_t size = 0; size + 11 < image.size(); ++size) EXPECT_NE(faultOf(image.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace dustbench::volumes
