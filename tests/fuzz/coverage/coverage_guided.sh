#!/bin/bash
# Runs our own readers under Clang's libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer for a while, starting with delivered
# files. Inputs that reach new branches are kept; failures are stored in FOLDER/findings.
#   coverage_guided.sh SECONDS FOLDER [READER...]       readers: toml csv obj ply stl vti; the seed is the clock's unless SEED gives it
#   coverage_guided.sh valgrind FOLDER [READER...]      reads all kept inputs again under valgrind, without sanitizers
set -euo pipefail
root="$(cd "$(dirname "$0")/../../.." && pwd)"
what="$1"
mkdir -p "$2"
folder="$(cd "$2" && pwd)"
shift 2
(($# > 0)) || set -- toml csv obj ply stl vti
seed="${SEED:-$(date +%s)}"
cd "$root"

sources=(tests/fuzz/coverage/readers.cpp methods/contract/errors.cpp
    methods/kit/files/{csv,data_folder,input_log,machine_error,printable,shipped_folder,toml_nesting,toml_reader,toml_text,whole_text}.cpp
    methods/kit/meshes/{mesh_text,obj_file,ply_file,ply_header,stl_file}.cpp
    methods/kit/volumes/{vti_file,vti_numbers,xml_scan}.cpp)
flags=(-std=c++20 -O1 -g1 -I. -DDUSTBENCH_API= -DTOML_HEADER_ONLY=0 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all)
libraries=(-ltomlplusplus -lfmt -lz -llz4)

if [[ $what == valgrind ]]; then
    g++ -std=c++20 -O1 -g -I. -DDUSTBENCH_API= -DTOML_HEADER_ONLY=0 -DDUSTBENCH_ALONE "${sources[@]}" -o "$folder/readers_alone" \
        "${libraries[@]}"
    for reader in "$@"; do
        echo "== $reader: $(find "$folder/$reader" -type f | wc -l) files"
        find "$folder/$reader" -type f -print0 | DUSTBENCH_FUZZ_READER="$reader" xargs -0 -n 5000 \
            valgrind --quiet --error-exitcode=1 --leak-check=full --errors-for-leak-kinds=definite "$folder/readers_alone"
    done
    exit
fi

seconds="$what"
clang++-16 "${flags[@]}" "${sources[@]}" -o "$folder/readers" "${libraries[@]}"

seeds() {
    case "$1" in
        toml) cp data/scenes/*.toml data/suites/*.toml "$2" ;;
        csv) cp data/drives/*.csv "$2" ;;
        vti) cp data/shapes/flow/whirl_0.vti "$2" ;;
        *) find data -name "*.$1" -size -64k -exec cp -t "$2" {} + ;;
    esac
}

status=0
mkdir -p "$folder/findings"
for reader in "$@"; do
    mkdir -p "$folder/$reader"
    seeds "$reader" "$folder/$reader"
    echo "== $reader, seed $seed"
    DUSTBENCH_FUZZ_READER="$reader" "$folder/readers" -seed="$((seed % 4000000000))" -max_total_time="$seconds" -max_len=65536 -timeout=20 \
        -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 -artifact_prefix="$folder/findings/$reader-" "$folder/$reader" || status=1
done
exit "$status"
