// Particle files as other programs write them: count, mass, centroid, first values and ignored columns of each, or the
// reason why it is refused.
//
// Tables have the formats of pandas, ParaView, Houdini and spreadsheets; columns have the names of Blender, Houdini,
// ParaView and OpenFOAM's clouds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "bench/world/dust_files.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/testing/python_script.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

struct DustRow {
    const char* what;
    std::string text;
    std::vector<std::string> ignored{};
    bool hasColour = false;
    const char* name = "dust.csv";
};

/// Two particles, of radius 0.5 and opacity 0.1: at (1, 2, 3), and at (4, 5, 6).
std::vector<DustRow> readRows() {
    const std::string plain = "x,y,z,radius,opacity\n1,2,3,0.5,0.1\n4,5,6,0.5,0.1\n";
    std::string carriage = plain, windows;
    for (char& letter : carriage) letter = letter == '\n' ? '\r' : letter;
    for (const char letter : plain) windows += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
    return {
        {"pandas to_csv(index=False)", plain},
        {"pandas to_csv", ",x,y,z,radius,opacity\n0,1,2,3,0.5,0.1\n1,4,5,6,0.5,0.1\n", {"column ''"}},
        {"pandas float_format='%.3e'",
         "x,y,z,radius,opacity\n1.000e+00,2.000e+00,3.000e+00,5.000e-01,1.000e-01\n"
         "4.000e+00,5.000e+00,6.000e+00,5.000e-01,1.000e-01\n"},
        {"pandas quoting=QUOTE_ALL",
         "\"x\",\"y\",\"z\",\"radius\",\"opacity\"\n\"1\",\"2\",\"3\",\"0.5\",\"0.1\"\n\"4\",\"5\",\"6\",\"0.5\",\"0."
         "1\"\n"},
        {"pandas lineterminator='\\r\\n'", windows},
        {"pandas lineterminator='\\r'", carriage},
        {"pandas encoding='utf-8-sig'", "\xEF\xBB\xBF" + plain},
        {"no end of the last line", plain.substr(0, plain.size() - 1)},
        {"a text column, and one of gaps",
         "name,x,y,z,radius,opacity,note\n\"a, b\",1,2,3,0.5,0.1,\nc,4,5,6,0.5,0.1,x\n",
         {"column 'name'", "column 'note'"}},
        {"ParaView, File > Save Data",
         "\"Points:0\",\"Points:1\",\"Points:2\",\"radius\",\"opacity\",\"vtkOriginalPointIds\"\n1,2,3,0.5,0.1,0\n"
         "4,5,6,0.5,0.1,1\n",
         {"column 'vtkOriginalPointIds'"}},
        {"ParaView 5.11",
         "Points_0,Points_1,Points_2,radius,opacity,Temp\n1,2,3,0.5,0.1,9\n4,5,6,0.5,0.1,9\n",
         {"column 'Temp'"}},
        {"Houdini's table of points",
         "P[x],P[y],P[z],pscale,Alpha,Cd[r],Cd[g],Cd[b],nage\n1,2,3,0.5,0.1,0.5,0.25,1,0\n4,5,6,0.5,0.1,0.5,0.25,1,0\n",
         {"column 'nage'"},
         true},
        {"Houdini's P.x",
         "P.x,P.y,P.z,pscale,Alpha,Cd.r,Cd.g,Cd.b\n1,2,3,0.5,0.1,0.5,0.25,1\n4,5,6,0.5,0.1,0.5,0.25,1\n",
         {},
         true},
        {"Blender's spreadsheet",
         "position_x,position_y,position_z,radius,opacity,id\n1,2,3,0.5,0.1,7\n4,5,6,0.5,0.1,8\n"},
        {"R, G and B are a colour",
         "x,y,z,pscale,alpha,R,G,B\n1,2,3,0.5,0.1,0.5,0.25,1\n4,5,6,0.5,0.1,0.5,0.25,1\n",
         {},
         true},
        {"radius before pscale",
         "x,y,z,radius,pscale,opacity\n1,2,3,0.5,9,0.1\n4,5,6,0.5,9,0.1\n",
         {"column 'pscale'"}},
        {"opacity before mass", "x,y,z,radius,mass,opacity\n1,2,3,0.5,9,0.1\n4,5,6,0.5,9,0.1\n", {"column 'mass'"}},
    };
}

void expectTheTwoParticles(const std::filesystem::path& file, const std::vector<std::string>& ignored, bool coloured) {
    const files::InputLog log;
    const DustFiles read = readDustFiles(file, {}, false);
    ASSERT_EQ(read.moments.size(), 1u);
    const DustMoment& moment = read.moments.front();
    ASSERT_EQ(moment.size(), 2u);
    EXPECT_EQ(glm::vec3(moment.x[0], moment.y[0], moment.z[0]), glm::vec3(1, 2, 3));
    EXPECT_EQ(glm::vec3(moment.x[1], moment.y[1], moment.z[1]), glm::vec3(4, 5, 6));
    for (const std::size_t i : {0u, 1u}) {
        EXPECT_EQ(moment.radius[i], 0.5f);
        EXPECT_EQ(moment.opacity[i], 0.1f);
    }
    ASSERT_EQ(moment.hasColour, coloured);
    if (coloured) {
        EXPECT_EQ(glm::vec3(moment.red[1], moment.green[1], moment.blue[1]), glm::vec3(0.5f, 0.25f, 1));
    }
    const auto logged = log.ignored();
    if (ignored.empty()) {
        EXPECT_TRUE(logged.empty()) << testing::PrintToString(logged);
    } else {
        EXPECT_THAT(logged.at(file), ElementsAreArray(ignored));
    }
}

TEST(DustWall, TablesThatOtherProgramsWriteAreTheSameTwoParticles) {
    const TestFolder folder;
    for (const DustRow& row : readRows()) {
        SCOPED_TRACE(row.what);
        expectTheTwoParticles(folder.write(row.name, row.text), row.ignored, row.hasColour);
    }
}

/// Writes tables with pandas, numpy and csv. A file's name begins with the expected result: read, ignore_COLUMN or
/// refuse_WORD, a word of the message.
constexpr const char* writeTables = R"(
import csv, sys, numpy, pandas
folder = sys.argv[1] + '/'
dust = pandas.DataFrame({'x': [1, 4], 'y': [2, 5], 'z': [3, 6], 'radius': [0.5, 0.5], 'opacity': [0.1, 0.1]})

def write(name, table=dust, **options):
    table.to_csv(folder + name + '.csv', **({'index': False} | options))

write('read_plain')
write('read_float32', dust.astype('float32'))
write('read_categories', dust.astype('category'))
write('read_exponents', float_format='%.3e')
write('read_quoted', quoting=csv.QUOTE_ALL)
write('read_quoted_names', quoting=csv.QUOTE_NONNUMERIC)
write('read_windows', lineterminator='\r\n')
write('read_old_mac', lineterminator='\r')
write('read_byte_order_mark', encoding='utf-8-sig')
write('read_shuffled_columns', columns=['opacity', 'z', 'radius', 'x', 'y'])
numpy.savetxt(folder + 'read_numpy.csv', dust.to_numpy(), delimiter=',', header='x,y,z,radius,opacity', comments='')
with open(folder + 'read_dict_writer.csv', 'w', newline='') as file:
    writer = csv.DictWriter(file, dust.columns)
    writer.writeheader()
    writer.writerows(dust.to_dict('records'))
write('ignore__index', index=True)
write('ignore_step_index', index=True, index_label='step')
write('ignore_note_text', dust.assign(note=['a, "b"', None]))
write('ignore_when_dates', dust.assign(when=pandas.to_datetime(['2026-01-01', '2026-01-02'])))
write('refuse_semicolons_german', sep=';', decimal=',')
write('refuse_tabs_tsv', sep='\t')
write('refuse_nan_gap', dust.assign(x=[None, 4.0]), na_rep='nan')
write('refuse_UTF-16_encoding', encoding='utf-16')
write('refuse_1,5_decimal', dust.assign(x=[1.5, 4.5]), decimal=',')
write('refuse_radius_levels', pandas.concat([dust, dust[['radius']] + 1], axis=1))
)";

TEST(DustWall, TablesOfPandasAreReadOrRefusedByTheirReason) {
    if (std::system("/usr/bin/python3 -c 'import pandas' 2>/dev/null") != 0 && !std::getenv("CI"))
        GTEST_SKIP() << "needs pandas (.ci/install pandas)";
    const TestFolder folder;
    (void)python(folder, writeTables, folder.path());
    std::map<std::string, int> counts;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().stem().string();
        SCOPED_TRACE(name);
        const std::size_t first = name.find('_') + 1;
        const std::string action = name.substr(0, first - 1), word = name.substr(first, name.find('_', first) - first);
        counts[action]++;
        if (action == "refuse") {
            EXPECT_THAT(inputError([&] { (void)readDustFiles(entry.path(), {}, false); }), HasSubstr(word));
        } else {
            const std::vector<std::string> column{"column '" + word + "'"};
            expectTheTwoParticles(entry.path(), action == "read" ? std::vector<std::string>() : column, false);
        }
    }
    EXPECT_EQ(counts, (std::map<std::string, int>{{"read", 12}, {"ignore", 4}, {"refuse", 6}}));
}

TEST(DustWall, TablesThatMeanSomethingElseAreRefusedByTheirReason) {
    const TestFolder folder;
    for (const auto& [what, text, reason] : std::vector<std::tuple<const char*, const char*, const char*>>{
             {"pandas sep=';', decimal=','", "x;y;z;radius;opacity\n1,0;2,0;3,0;0,5;0,1\n", "semicolons"},
             {"pandas sep='\\t'", "x\ty\tz\tradius\topacity\n1\t2\t3\t0.5\t0.1\n", "tabs"},
             {"decimal=',' in quotes", "x,y,z,radius,opacity\n\"1,5\",2,3,0.5,0.1\n", "'1,5'"},
             {"thousands", "x,y,z,radius,opacity\n\"1,234.5\",2,3,0.5,0.1\n", "'1,234.5'"},
             {"thousands with blanks", "x,y,z,radius,opacity\n1 234.5,2,3,0.5,0.1\n", "'1 234.5'"},
             {"pandas na_rep='NaN'", "x,y,z,radius,opacity\nNaN,2,3,0.5,0.1\n", "'NaN'"},
             {"a gap in a column that counts", "x,y,z,radius,opacity\n,2,3,0.5,0.1\n", "''"},
             {"whole numbers of 0..255", "x,y,z,radius,opacity,r,g,b\n1,2,3,0.5,0.1,255,0,0\n",
              "whole numbers up to 255"},
             {"two columns of a name", "x,y,z,radius,radius,opacity\n1,2,3,0.5,0.7,0.1\n", "radius"},
             {"a column that is not there", "x,y,z,opacity\n1,2,3,0.1\n", "no column for radius"},
             {"UTF-16", "\xFF\xFEx", "UTF-16"},
             {"opacity of 0..255", "x,y,z,radius,opacity\n1,2,3,0.5,25\n", "opacity is 25, allowed: 0..1"}})
        EXPECT_THAT(inputError([&] { (void)readDustFiles(folder.write("dust.csv", text), {}, false); }),
                    HasSubstr(reason))
            << what;
}

}  // namespace
}  // namespace dustbench::world
