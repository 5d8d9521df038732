#include "bench/cli/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <initializer_list>
#include <string_view>

#include "bench/cli/exit_codes.h"

namespace dustbench::cli {
namespace {

volatile sig_atomic_t interruptions = 0;

void countInterruption(int) {
    interruptions = interruptions + 1;
}

/// Calls only functions that are safe in a signal handler.
void endAtOnce(int) {
    constexpr std::string_view message = "aborted; repeat the command to resume\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    _exit(exitAborted);
}

void handleBy(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    for (const int signalNumber : {SIGINT, SIGTERM, SIGHUP}) sigaction(signalNumber, &action, nullptr);
}

}  // namespace

void listenForInterruption() {
    handleBy(countInterruption);
}

EndsWhenInterrupted::EndsWhenInterrupted() {
    handleBy(endAtOnce);
    if (interrupted()) endAtOnce(SIGINT);
}

bool interrupted() {
    return interruptions != 0;
}

}  // namespace dustbench::cli
