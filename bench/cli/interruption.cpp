#include "bench/cli/interruption.h"

#include <signal.h>

#include <initializer_list>

namespace dustbench::cli {
namespace {

volatile sig_atomic_t interruptions = 0;

void countInterruption(int) {
    interruptions = interruptions + 1;
}

}  // namespace

void listenForInterruption() {
    struct sigaction action {};
    action.sa_handler = countInterruption;
    for (const int signalNumber : {SIGINT, SIGTERM, SIGHUP}) sigaction(signalNumber, &action, nullptr);
}

bool interrupted() {
    return interruptions != 0;
}

}  // namespace dustbench::cli
