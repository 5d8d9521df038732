#include "bench/export/series.h"

#include <fmt/format.h>

#include "bench/export/whole_file.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

void Series::add(std::string_view name, double timeSeconds) {
    const std::string time = files::csvNumber(timeSeconds);
    if (kind_ == Kind::pvd) {
        entries_ += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time, name);
        writeWhole(file_,
                   "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                   "byte_order=\"LittleEndian\">\n  <Collection>\n" +
                       entries_ + "  </Collection>\n</VTKFile>\n");
        return;
    }
    entries_ += fmt::format("{}    {{ \"name\": \"{}\", \"time\": {} }}", entries_.empty() ? "" : ",\n", name, time);
    writeWhole(file_, "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n" + entries_ + "\n  ]\n}\n");
}

}  // namespace dustbench::bench
