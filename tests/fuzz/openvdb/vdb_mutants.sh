#!/bin/bash
# Reads mutated OpenVDB and NanoVDB files under AddressSanitizer and UndefinedBehaviorSanitizer.
#   vdb_mutants.sh CASES FOLDER        one process per core; the default of SEED is the time
set -euo pipefail
cases="$1"
mkdir -p "$2"
folder="$(cd "$2" && pwd)"
cd "$(dirname "$0")/../../.."
seed="${SEED:-$(date +%s)}"

sources=(tests/fuzz/openvdb/vdb_mutants.cpp methods/contract/errors.cpp
    methods/kit/files/{csv,data_folder,input_log,machine_error,matching_files,printable,shipped_folder,whole_text}.cpp
    methods/kit/volumes/{file_series,grid_place,vdb_process,volume_file,volume_series,vti_fields,vti_file,vti_numbers,xml_scan}.cpp
    methods/volume/sparse/brick_reader.cpp
    methods/kit/volumes/openvdb/{vdb_reader,volume_answer,nano_volume_answer}.cpp tests/fuzz/nano_ball.cpp)
g++ -std=c++20 -O1 -g1 -I. -DDUSTBENCH_API= -fsanitize=address,undefined -fno-sanitize-recover=all -isystem /usr/include/Imath \
    -Wl,--wrap=waitpid,--wrap=_exit "${sources[@]}" -o "$folder/vdb_mutants" -lopenvdb -ltbb -lImath-3_1 -lfmt -lz -llz4 -lblosc

# The worker ends often; its messages are not read, and it counts its memory itself. This process may hold a box of 89 million
# cells in memory while its vector grows.
options=detect_leaks=0:symbolize=0:malloc_context_size=0:quarantine_size_mb=1:allocator_may_return_null=1:max_allocation_size_mb=2500
jobs="$(nproc)"
for ((job = 0; job < jobs; ++job)); do
    ASAN_OPTIONS="$options" "$folder/vdb_mutants" "$((seed + job))" "$((cases / jobs))" "$folder/$job" &
done
status=0
for ((job = 0; job < jobs; ++job)); do wait -n || status=1; done
exit "$status"
