#include "interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <thread>

#include <pthread.h>
#include <unistd.h>

#include "tinwright/io/atomic_output.hpp"

namespace tinwright::tools {

namespace {

// A signal can be told from anywhere, and so can what it sets: the first signal, or 0.
std::atomic<int> interrupted_by{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void wait_for_signals(const sigset_t& signals) {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) {
        return;
    }
    interrupted_by = signal;
    if (sigwait(&signals, &signal) == 0) {
        io::discard_unfinished_outputs();
        _exit(1);
    }
}

}  // namespace

void watch_for_interrupts() {
    std::signal(SIGPIPE, SIG_IGN);
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction current {};
        if (sigaction(signal, nullptr, &current) == 0 && current.sa_handler != SIG_IGN) {
            sigaddset(&signals, signal);
        }
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread([signals] { wait_for_signals(signals); }).detach();
}

bool is_interrupted() { return interrupted_by != 0; }

bool take_interrupt() {
    int expected = SIGINT;
    return interrupted_by.compare_exchange_strong(expected, 0) || expected != 0;
}

}  // namespace tinwright::tools
