// Cost of exporting: grids from puffs, and a 256³ .vti compared with a plain call of VTK's writer with the same
// compressor.
#include <benchmark/benchmark.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <chrono>
#include <filesystem>

#include "bench/export/format_writers.h"
#include "bench/export/test_clouds.h"

namespace dustbench::exports {
namespace {
namespace fs = std::filesystem;

constexpr int edgeCells = 256;

/// A cubic grid that the cloud mostly fills.
const ExtinctionGrid& cubeGrid() {
    static const ExtinctionGrid grid = [] {
        const TestDust dust(5000, 10, 0.2f, 1);
        return computeGrid(dust.volume(), planGrid(Box{{-5, -9, -17}, {15, 11, 3}}, edgeCells));
    }();
    return grid;
}

fs::path someFile(const char* extension) {
    return fs::temp_directory_path() / ("export_bench_" + std::to_string(getpid()) + extension);
}

/// A plain VTK export of the same array with all defaults, or with the data appended after the XML, as ours does.
void writePlainly(const ExtinctionGrid& grid, const fs::path& file, bool appendedRaw) {
    vtkNew<vtkFloatArray> extinction;
    extinction->SetName("extinction");
    extinction->SetArray(const_cast<float*>(grid.extinctionPerMetre.data()), grid.plan.cellCount(), 1);
    vtkNew<vtkImageData> image;
    image->SetDimensions(edgeCells + 1, edgeCells + 1, edgeCells + 1);
    image->GetCellData()->SetScalars(extinction);
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->SetCompressorTypeToLZ4();
    if (appendedRaw) writer->EncodeAppendedDataOff();
    writer->Write();
}

/// Interleaved, so that drift of the machine affects both alike. `ratio`: our time divided by VTK's plain call.
void vtiBesideAPlainCall(benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    const ExtinctionGrid& grid = cubeGrid();
    const fs::path ours = someFile("_ours.vti"), plain = someFile("_plain.vti");
    std::chrono::duration<double> ourTime{}, plainTime{};
    for (auto _ : state) {
        const auto start = Clock::now();
        writeVti(grid, 1, ours);
        const auto middle = Clock::now();
        writePlainly(grid, plain, state.range(0) != 0);
        ourTime += middle - start;
        plainTime += Clock::now() - middle;
    }
    state.counters["ours_s"] = ourTime.count() / static_cast<double>(state.iterations());
    state.counters["plain_s"] = plainTime.count() / static_cast<double>(state.iterations());
    state.counters["ratio"] = ourTime / plainTime;
    state.counters["bytes"] = static_cast<double>(fs::file_size(ours));
    fs::remove(ours);
    fs::remove(plain);
}
BENCHMARK(vtiBesideAPlainCall)
    ->ArgName("raw")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(6);

void vdb(benchmark::State& state) {
    const fs::path file = someFile(".vdb");
    for (auto _ : state) writeVdb(cubeGrid(), VdbPrecision::half, 0, 1, file);
    state.counters["bytes"] = static_cast<double>(fs::file_size(file));
    fs::remove(file);
}
BENCHMARK(vdb)->Unit(benchmark::kMillisecond)->UseRealTime();

void gridOfPuffs(benchmark::State& state) {
    const TestDust dust(static_cast<std::size_t>(state.range(0)), 10, 0.1f, 2);
    const CollectedVolume volume = dust.volume();
    const GridPlan plan = planGrid(volume.bounds(), static_cast<int>(state.range(1)));
    for (auto _ : state) benchmark::DoNotOptimize(computeGrid(volume, plan));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(gridOfPuffs)->Args({10'000, 128})->Args({100'000, 128})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dustbench::exports
