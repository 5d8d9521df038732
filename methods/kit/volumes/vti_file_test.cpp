#include "methods/kit/volumes/vti_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <zlib.h>

#include <random>

#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::volumes {
namespace {

using ::testing::ElementsAre;
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

std::vector<float> numbersIn(const std::string& text) {
    const TestFolder folder;
    const VtiFile file(folder.write("a.vti", text));
    return file.numbersOf(file.cellArrays().front());
}

/// The reason for the refusal; empty if the file is accepted.
std::string faultOf(const std::string& text) {
    try {
        (void)numbersIn(text);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

std::string with(const std::string& from, const std::string& to, std::string text = image) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

/// The image with these raw appended bytes.
std::string withRaw(const std::string& bytes, const std::string& root = "") {
    std::string text = with("format=\"ascii\">1 2 3 4 5 6", "format=\"appended\" offset=\"0\">");
    text = with("header_type=\"UInt64\"", "header_type=\"UInt64\" " + root, text);
    return with("</VTKFile>", "<AppendedData encoding=\"raw\">\n _" + bytes + "\n</AppendedData></VTKFile>", text);
}

std::string words(const std::vector<std::uint64_t>& list) {
    return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(std::uint64_t)};
}

std::string floats(const std::vector<float>& list) {
    return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(float)};
}

// VTK writes and reads.

template <typename Array>
void fill(vtkDataArray& array, const char* name, int components, vtkIdType tuples, Array& random) {
    array.SetName(name);
    array.SetNumberOfComponents(components);
    array.SetNumberOfTuples(tuples);
    std::uniform_real_distribution<double> any(0, 120);
    for (vtkIdType i = 0; i < tuples; ++i)
        for (int c = 0; c < components; ++c) array.SetComponent(i, c, any(random));
}

/// A grid off the origin with arrays of all types.
vtkSmartPointer<vtkImageData> madeImage(unsigned seed) {
    std::mt19937 random(seed);
    const auto made = vtkSmartPointer<vtkImageData>::New();
    made->SetExtent(-2, 3, 1, 5, 0, 3);
    made->SetOrigin(0.1, -7, 1e-3);
    made->SetSpacing(0.3, 0.3, 0.3);
    constexpr std::array types{VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,     VTK_UNSIGNED_SHORT,
                               VTK_INT,         VTK_UNSIGNED_INT,  VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
                               VTK_FLOAT,       VTK_DOUBLE};
    for (std::size_t i = 0; i < types.size(); ++i) {
        const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(types[i]));
        fill(*array, fmt::format("array {}", i).c_str(), 1 + static_cast<int>(i % 3), made->GetNumberOfCells(), random);
        made->GetCellData()->AddArray(array);
    }
    vtkNew<vtkDoubleArray> points, time;
    fill(*points, "points", 1, made->GetNumberOfPoints(), random);
    made->GetPointData()->AddArray(points);
    fill(*time, "TimeValue", 1, 1, random);
    made->GetFieldData()->AddArray(time);
    vtkNew<vtkStringArray> unit;
    unit->SetName("unit");
    unit->InsertNextValue("m/s");
    made->GetFieldData()->AddArray(unit);
    return made;
}

/// How VTK writes a file: 0 ascii, 1 inline base64, 2 appended base64, 3 appended raw.
struct Way {
    int mode, compressor, header, order;
    [[nodiscard]] std::string name() const {
        return fmt::format("mode {}, compressor {}, header {}, order {}", mode, compressor, header, order);
    }
};

std::vector<Way> allWays() {
    std::vector<Way> ways;
    for (const int mode : {0, 1, 2, 3})
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4})
            for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64})
                for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian})
                    ways.push_back({mode, compressor, header, order});
    return ways;
}

void write(vtkImageData& made, const Way& way, const std::filesystem::path& file) {
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(&made);
    writer->SetDataMode(way.mode == 0   ? vtkXMLWriter::Ascii
                        : way.mode == 1 ? vtkXMLWriter::Binary
                                        : vtkXMLWriter::Appended);
    writer->SetEncodeAppendedData(way.mode == 2);
    writer->SetCompressorType(way.compressor);
    writer->SetBlockSize(128);  // several blocks an array, the last one shorter
    writer->SetHeaderType(way.header);
    writer->SetByteOrder(way.order);
    ASSERT_EQ(writer->Write(), 1);
}

TEST(VtiFile, GivesWhatVtkGivesInEveryWayOfWriting) {
    const TestFolder folder;
    unsigned seed = 20'260'728;
    for (const Way& way : allWays()) {
        const auto file = folder.path() / "a.vti";
        write(*madeImage(seed++), way, file);
        vtkNew<vtkXMLImageDataReader> reader;
        reader->SetFileName(file.c_str());
        reader->Update();
        vtkImageData& expected = *reader->GetOutput();
        const VtiFile vti(file);
        ASSERT_EQ(vti.cells(), glm::ivec3(5, 4, 3)) << way.name();
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(vti.spacing()[axis], expected.GetSpacing()[axis]);
            EXPECT_EQ(vti.origin()[axis],
                      expected.GetOrigin()[axis] + expected.GetExtent()[2 * axis] * expected.GetSpacing()[axis]);
        }
        EXPECT_EQ(vti.fieldNumber("TimeValue"), expected.GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0));
        EXPECT_FALSE(vti.fieldNumber("unit"));
        ASSERT_EQ(vti.cellArrays().size(), 10u);
        for (const VtiArray& array : vti.cellArrays()) {
            vtkDataArray& wanted = *expected.GetCellData()->GetArray(array.name.c_str());
            ASSERT_EQ(array.components, wanted.GetNumberOfComponents()) << way.name();
            const std::vector<float> got = vti.numbersOf(array);
            ASSERT_EQ(got.size(), static_cast<std::size_t>(wanted.GetNumberOfValues()));
            std::vector<float> streamed;
            vti.streamNumbers(array, [&](std::span<const float> piece) {
                streamed.insert(streamed.end(), piece.begin(), piece.end());
            });
            EXPECT_EQ(streamed, got);
            for (std::size_t i = 0; i < got.size(); ++i)
                ASSERT_EQ(got[i], static_cast<float>(wanted.GetComponent(static_cast<vtkIdType>(i) / array.components,
                                                                         static_cast<int>(i) % array.components)))
                    << way.name() << ", " << array.name << ", " << i;
        }
    }
}

TEST(VtiFile, IsRefusedIfItIsCutAnywhere) {
    const TestFolder folder;
    for (const Way& way : {Way{0, vtkXMLWriter::NONE, vtkXMLWriter::UInt64, vtkXMLWriter::LittleEndian},
                           Way{1, vtkXMLWriter::ZLIB, vtkXMLWriter::UInt32, vtkXMLWriter::LittleEndian},
                           Way{3, vtkXMLWriter::LZ4, vtkXMLWriter::UInt64, vtkXMLWriter::LittleEndian}}) {
        const auto file = folder.path() / "whole.vti";
        write(*madeImage(1), way, file);
        const std::string text = files::wholeText(file, "a volume");
        ASSERT_NO_THROW(VtiFile{file});
        for (std::size_t size = 0; size + 1 < text.size(); size += size + 200 < text.size() ? 7 : 1)
            ASSERT_THROW(VtiFile{folder.write("cut.vti", text.substr(0, size))}, InputError)
                << way.name() << ", " << size << " of " << text.size();
    }
}

TEST(VtiFile, TakesCommentsAndKeysAndRawBytesThatLookLikeXml) {
    EXPECT_THAT(numbersIn(image), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(numbersIn(with("1 2 3", "+1 2e0 .3e1")), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(numbersIn(withRaw(words({24}) + floats({1, 2, 3, 4, 5, 6}))), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_EQ(numbersIn(withRaw(words({24}) + "</AppendedData></VTKFile>  ")).size(), 6u);
    EXPECT_EQ(faultOf(withRaw(words({24}) + "<&>\"0123456789</ImageData")), "");
}

TEST(VtiFile, RefusesArraysThatAreNotExactlyAsLongAsTheirExtent) {
    EXPECT_THAT(faultOf(with("5 6", "5")), HasSubstr("shorter than its extent"));
    EXPECT_THAT(faultOf(with("5 6", "5 6 7")), HasSubstr("longer than its extent"));
    EXPECT_THAT(faultOf(withRaw(words({20}) + floats({1, 2, 3, 4, 5}))), HasSubstr("20 bytes, expected 24"));
    EXPECT_THAT(faultOf(withRaw(words({28}) + floats({1, 2, 3, 4, 5, 6, 7}))), HasSubstr("28 bytes, expected 24"));
    EXPECT_THAT(faultOf(withRaw(words({24}) + floats({1, 2, 3, 4}))), HasSubstr("shorter than its extent"));
    EXPECT_THAT(faultOf(withRaw("123")), HasSubstr("beyond the end"));
    EXPECT_THAT(faultOf(with("offset=\"0\"", "offset=\"33\"", withRaw(words({24}) + floats({1, 2, 3, 4, 5, 6})))),
                HasSubstr("missing or truncated"));
    EXPECT_THAT(faultOf(with("ascii\">1 2 3 4 5 6", "binary\">GAAAAAAAAAAAAIA/AAAAQAAAQEAAAIBAAACgQAAAwEA")),
                HasSubstr("array"));
    EXPECT_EQ(faultOf(with("ascii\">1 2 3 4 5 6", "binary\">GAAAAAAAAAAAAIA/AAAAQAAAQEAAAIBAAACgQAAAwEA=")), "");
    EXPECT_THAT(faultOf(with("ascii\">1 2 3 4 5 6", "binary\">GAAAAAAAAAAAAIA/AAAAQAAAQEAAAIBAAACgQAAAwEA=AAAA")),
                HasSubstr("longer than its extent"));
    EXPECT_THAT(faultOf(with("ascii\">1 2 3 4 5 6", "binary\">GAAAAAAAAAAAAIA/AAA*QAAAQEAAAIBAAACgQAAAwEA=")),
                HasSubstr("not in base64"));
}

std::string byZlib(const std::string& bytes) {
    uLongf length = compressBound(bytes.size());
    std::string made(length, ' ');
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(made.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()),
              Z_OK);
    return made.substr(0, length);
}

TEST(VtiFile, RefusesBlocksThatAreNotExactlyAsLongAsTheArray) {
    const auto inBlocks = [](const std::vector<float>& first, const std::vector<float>& last) {
        const std::string a = byZlib(floats(first)), b = byZlib(floats(last));
        return withRaw(words({2, 16, 4 * last.size(), a.size(), b.size()}) + a + b,
                       "compressor=\"vtkZLibDataCompressor\"");
    };
    EXPECT_THAT(numbersIn(inBlocks({1, 2, 3, 4}, {5, 6})), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(faultOf(inBlocks({1, 2, 3, 4}, {5})), HasSubstr("20 bytes, expected 24"));
    EXPECT_THAT(faultOf(inBlocks({1, 2, 3, 4}, {5, 6, 7})), HasSubstr("28 bytes, expected 24"));
    EXPECT_THAT(faultOf(inBlocks({1, 2, 3, 4, 5}, {5, 6})), HasSubstr("damaged"));
    EXPECT_THAT(faultOf(inBlocks({1, 2, 3}, {5, 6})), HasSubstr("damaged"));
}

/// Blocks with false lengths, which VTK uses as offsets, divisors and sizes.
TEST(VtiFile, RefusesForgedBlocks) {
    const std::string data(64, 'x');
    constexpr std::uint64_t huge = ~std::uint64_t{0};
    const std::vector<std::vector<std::uint64_t>> headers{{0, 24, 0},
                                                          {0, 24, 24},
                                                          {1, 0, 24, 8},
                                                          {1, 0, 0, 8},
                                                          {1, 24, 25, 8},
                                                          {1, 12, 0, 8},
                                                          {2, 12, 0, 8, huge},
                                                          {2, 12, 0, 8, 1'000'000},
                                                          {2, 12, 0, 0, 0},
                                                          {3, 7, 10, 8, 8, 8},
                                                          {1, huge, 24, 8},
                                                          {huge / 16 + 1, 24, 0, 8},
                                                          {1, 24, 0, 8},
                                                          {huge, huge, huge},
                                                          {huge / 8 + 1, huge / 8 + 1, 24}};
    for (const std::vector<std::uint64_t>& header : headers)
        for (const char* compressor : {"vtkZLibDataCompressor", "vtkLZ4DataCompressor"})
            EXPECT_THAT(faultOf(withRaw(words(header) + data, fmt::format("compressor=\"{}\"", compressor))),
                        HasSubstr("array"))
                << compressor << " " << testing::PrintToString(header);
    EXPECT_THAT(faultOf(withRaw(data, "compressor=\"vtkLZMADataCompressor\"")),
                HasSubstr("its compressor is 'vtkLZMADataCompressor', allowed: vtkZLib"));
}

TEST(VtiFile, RefusesArraysOfNothingAndOfUnknownTypes) {
    EXPECT_THAT(faultOf(with("1 2 3 4 5 6", "")), HasSubstr("an array is empty"));
    EXPECT_THAT(faultOf(with("1 2 3 4 5 6", " \n\t")), HasSubstr("an array is empty"));
    EXPECT_THAT(faultOf(with("format=\"ascii\">1 2 3 4 5 6", "format=\"binary\">")), HasSubstr("an array is empty"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfComponents=\"0\"")), HasSubstr("allowed: 1..64"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfComponents=\"-1\"")), HasSubstr("allowed: 1..64"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfTuples=\"99999999999\"")),
                HasSubstr("NumberOfTuples"));
    EXPECT_THAT(faultOf(with("NumberOfComponents=\"3\"", "NumberOfComponents=\"3\" NumberOfTuples=\"3\"")),
                HasSubstr("NumberOfTuples of an array is 3, expected 2"));
    for (const char* type : {"", "type=\"float\"", "tyqe=\"Float32\"", "type=\"vtkIdType\""})
        EXPECT_THAT(faultOf(with("type=\"Float32\"", type)), HasSubstr("an array has the type '")) << type;
    EXPECT_THAT(faultOf(with("ascii", "ascii2")), HasSubstr("its format is 'ascii2'"));
    for (const char* word : {"nope", "3x", "1e39", "1e999", "-", "3,"})
        EXPECT_THAT(faultOf(with("1 2 3", std::string("1 2 ") + word)), HasSubstr("Float32 contains")) << word;
    EXPECT_EQ(numbersIn(with("1 2 3", "1 2 1e-999"))[2], 0);
    EXPECT_THAT(faultOf(with("Float32", "UInt8", with("1 2 3", "1 2 3.5"))), HasSubstr("UInt8 contains '3.5'"));
}

TEST(VtiFile, RefusesExtentsThatDoNotFit) {
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"0 2000000000")), HasSubstr("ends before it begins"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2 0 1", "WholeExtent=\"0 200000 0 200000")),
                HasSubstr("allowed: 256000000"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"0 9000000")), HasSubstr("do not fit into its"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"3 2")), HasSubstr("ends before"));
    EXPECT_THAT(faultOf(with("WholeExtent=\"0 2", "WholeExtent=\"2 2")), HasSubstr("it is flat"));
    EXPECT_THAT(faultOf(with("Piece Extent=\"0 2", "Piece Extent=\"0 1")), HasSubstr("not cover its whole extent"));
    EXPECT_THAT(faultOf(with("Piece Extent=\"0 2", "Piece Extent=\"0 3")), HasSubstr("not cover its whole extent"));
    EXPECT_THAT(faultOf(with("Piece Extent=\"0 2", "Piece Extent=\"x 3")), HasSubstr("six integers"));
    for (const char* three : {"1 1", "1 1 1 1", "1 1 nan", "1 1 inf", "1 1e10 1", "1 1 x", ""})
        EXPECT_THAT(faultOf(with("Spacing=\"1 1 1\"", fmt::format("Spacing=\"{}\"", three))),
                    HasSubstr("three numbers"));
    EXPECT_THAT(faultOf(with("Spacing=", "Direction=\"0 1 0 1 0 0 0 0 1\" Spacing=")), HasSubstr("turned"));
    EXPECT_THAT(faultOf(with("Spacing=", "Direction=\"1 0.0001 0 0 1 0 0 0 1\" Spacing=")), HasSubstr("turned"));
    EXPECT_THAT(faultOf(with("Spacing=", "Direction=\"1 0 0 0 1 0 0 0 nan\" Spacing=")), HasSubstr("turned"));
    for (const char* upright : {"1 0 0 0 1 0 0 0 1", "0.9999999999999999 0 0 0 1 0 0 0 1",
                                "1 -1.2246e-16 0 1.2246e-16 1.0000000000000002 0 0 0 1"})
        EXPECT_EQ(faultOf(with("Spacing=", std::string("Direction=\"") + upright + "\" Spacing=")), "") << upright;
}

/// The element between its tags.
std::string element(const std::string& name) {
    const std::size_t start = image.find("<" + name), end = image.find("</" + name + ">") + name.size() + 3;
    return image.substr(start, end - start);
}

TEST(VtiFile, RefusesOtherXml) {
    for (const char* text : {"", "no volume", "<", "<a", "<a b", "<a b=", "<a b='c", "<!--", "</VTKFile>"})
        EXPECT_THAT(faultOf(text), HasSubstr("not a complete VTK image data file")) << text;
    EXPECT_THAT(faultOf(with("type=\"ImageData\"", "type=\"PolyData\"")), HasSubstr("not image data"));
    EXPECT_THAT(faultOf(with("<!-- two cells -->", "<!DOCTYPE a [<!ENTITY a \"b\">]>")), HasSubstr("document type"));
    EXPECT_THAT(faultOf(with("version=\"1.0\" byte", "version=\"3.0\" byte")), HasSubstr("its version is '3.0'"));
    EXPECT_THAT(faultOf(with("LittleEndian", "MiddleEndian")), HasSubstr("its byte_order is 'MiddleEndian'"));
    for (const char* name : {"Piece", "CellData", "DataArray", "ImageData"})
        EXPECT_NE(faultOf(with(element(name), element(name) + element(name))), "") << name << " twice";
    for (const char* name : {"Piece", "CellData", "DataArray", "ImageData"})
        EXPECT_NE(faultOf(with(element(name), "")), "") << "no " << name;
    EXPECT_THAT(faultOf(with("<CellData>", "<CellData>7")), HasSubstr("text outside"));
    EXPECT_THAT(faultOf(image + "7"), HasSubstr("text outside"));
    EXPECT_NE(faultOf(image + image), "");
    EXPECT_THAT(faultOf(with("<CellData>", "<CellData><Cells/>")), HasSubstr("unexpected element 'Cells'"));
    std::string comments;
    for (int i = 0; i < 300'000; ++i) comments += "<!---->";
    EXPECT_EQ(faultOf(with("<!-- two cells -->", comments)), "");
}

}  // namespace
}  // namespace dustbench::volumes
