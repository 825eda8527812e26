#include "interrupt.hpp"

#include <chrono>
#include <csignal>
#include <thread>

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "progress.hpp"

namespace {

using namespace tinwright::tools;

/// Sends a signal to this process and waits until it is noticed.
bool is_noticed(int signal) {
    kill(getpid(), signal);
    for (int i = 0; i < 10'000 && !is_interrupted(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return is_interrupted();
}

/// Runs `body` in a process of its own, where signals are watched for; returns its exit status.
template <class Body>
int status_of(const Body& body) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        std::signal(SIGINT, SIG_DFL);
        watch_for_interrupts();
        _exit(body());
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

}  // namespace

TEST_SUITE("tools/interrupt") {
    TEST_CASE("a stage that is not to be left early stops for good at the first Ctrl-C") {
        CHECK(status_of([] {
                  ProgressLine line(nullptr);
                  const auto stage = line.stage(0, 1);
                  const bool went_on = stage(0.1);
                  return went_on && is_noticed(SIGINT) && !stage(0.2) && !stage(0.3) ? 7 : 8;
              }) == 7);
    }

    TEST_CASE("Ctrl-C ends a stage that may be left, and the stages that follow go on") {
        CHECK(status_of([] {
                  ProgressLine line(nullptr);
                  const auto optimizing = line.stage_to_leave(0, 0.5);
                  const auto writing = line.stage(0.5, 1);
                  const bool went_on = optimizing(0.1);
                  const bool left = is_noticed(SIGINT) && !optimizing(0.2);
                  return went_on && left && writing(0.5) && writing(1) ? 7 : 8;
              }) == 7);
    }

    TEST_CASE("the second Ctrl-C ends the process with status 1, whatever the first one did") {
        for (const bool is_first_taken : {false, true}) {
            CAPTURE(is_first_taken);
            CHECK(status_of([is_first_taken] {
                      if (!is_noticed(SIGINT) || (is_first_taken && !take_interrupt())) {
                          return 8;
                      }
                      kill(getpid(), SIGINT);
                      std::this_thread::sleep_for(std::chrono::seconds(10));
                      return 9;
                  }) == 1);
        }
    }

    TEST_CASE("a signal that ends the program leaves no result behind") {
        CHECK(status_of([] {
                  ProgressLine line(nullptr);
                  const auto optimizing = line.stage_to_leave(0, 0.5);
                  const auto writing = line.stage(0.5, 1);
                  return is_noticed(SIGTERM) && !optimizing(0.2) && !writing(0.5) ? 7 : 8;
              }) == 7);
    }
}
