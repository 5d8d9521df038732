// The program dustbench_vdb_reader: reads a field of vectors, or points, from a `.vdb` and writes it to its standard
// output (vdb_message.h). It is a separate process, so that a damaged file cannot crash another one.
//
//     dustbench_vdb_reader FILE FIELD
//     dustbench_vdb_reader --points FILE
#include "methods/kit/volumes/openvdb/vdb_reader.h"

#ifdef __SANITIZE_ADDRESS__
/// In place of the limit that limitVdbReader sets without sanitizers.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): AddressSanitizer's name
    return "hard_rss_limit_mb=768";
}
#endif

int main(int argc, char** argv) {
    if (argc != 3) return 3;
    dustbench::volumes::limitVdbReader(dustbench::volumes::vdbFile(argv[1], argv[2]));
    dustbench::volumes::runVdbReader(argv[1], argv[2]);
}
