#include "benchmarks/measure.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tinwright_benchmarks {

namespace {

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double cpu_seconds(const rusage& usage) { return seconds(usage.ru_utime) + seconds(usage.ru_stime); }

double own_cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return cpu_seconds(usage);
}

double wall_clock() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A line of /proc/self/status such as VmRSS or VmHWM, in bytes.
double status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(name + ":")) {
            return 1024 * std::strtod(line.c_str() + name.size() + 1, nullptr);
        }
    }
    throw std::runtime_error("/proc/self/status has no " + name);
}

/// Makes the peak start again from what is resident now.
void forget_peak() {
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;
    if (!file) {
        throw std::runtime_error("/proc/self/clear_refs cannot be written");
    }
}

[[noreturn]] void run_child(const Work& work, int pipe_end) {
    try {
        Meter meter;
        work(meter);
        const Measured measured = meter.measured();
        const bool is_sent = write(pipe_end, &measured, sizeof measured) == sizeof measured;
        std::fflush(nullptr);
        _exit(is_sent ? 0 : 1);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "benchmark: %s\n", error.what());
        _exit(1);
    }
}

pid_t fork_process() {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) {
        throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
    }
    return child;
}

/// Waits for `child`; throws unless it returned 0.
rusage wait_for(pid_t child, const std::string& name) {
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0) {
        if (errno != EINTR) {
            throw std::runtime_error("lost a process: " + name);
        }
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error("failed: " + name);
    }
    return usage;
}

template <class Figure>
double median(const std::vector<Measured>& runs, Figure figure) {
    std::vector<double> values(runs.size());
    std::transform(runs.begin(), runs.end(), values.begin(),
                   [&](const Measured& run) { return run.*figure; });
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

void Meter::start() {
    malloc_trim(0);
    forget_peak();
    resident_at_start_ = status_bytes("VmRSS");
    cpu_at_start_ = own_cpu_seconds();
    wall_at_start_ = wall_clock();
}

void Meter::stop() {
    measured_.wall_seconds = wall_clock() - wall_at_start_;
    measured_.cpu_seconds = own_cpu_seconds() - cpu_at_start_;
    measured_.peak_bytes = status_bytes("VmHWM") - resident_at_start_;
}

Measured measure_in_child(const Work& work) {
    int ends[2];
    if (pipe(ends) != 0) {
        throw std::runtime_error("cannot make a pipe");
    }
    const pid_t child = fork_process();
    if (child == 0) {
        close(ends[0]);
        run_child(work, ends[1]);
    }
    close(ends[1]);
    Measured measured;
    const bool is_received = read(ends[0], &measured, sizeof measured) == sizeof measured;
    close(ends[0]);
    wait_for(child, "a measurement");
    if (!is_received) {
        throw std::runtime_error("a measurement gave no figures");
    }
    return measured;
}

void do_in_child(const std::function<void()>& work) {
    measure_in_child([&](Meter& /*meter*/) { work(); });
}

Measured measure_program(const std::vector<std::string>& arguments) {
    const double start = wall_clock();
    const pid_t child = fork_process();
    if (child == 0) {
        std::vector<char*> texts;
        for (const std::string& argument : arguments) {
            texts.push_back(const_cast<char*>(argument.c_str()));
        }
        texts.push_back(nullptr);
        dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
        execvp(texts[0], texts.data());
        std::fprintf(stderr, "benchmark: cannot run %s\n", texts[0]);
        _exit(127);
    }
    std::string command;
    for (const std::string& argument : arguments) {
        command += command.empty() ? argument : " " + argument;
    }
    const rusage usage = wait_for(child, command);
    Measured measured;
    measured.wall_seconds = wall_clock() - start;
    measured.cpu_seconds = cpu_seconds(usage);
    measured.peak_bytes = 1024 * static_cast<double>(usage.ru_maxrss);
    return measured;
}

std::vector<Measured> measure_in_turn(std::span<const std::function<Measured()>> contenders, int rounds) {
    std::vector<std::vector<Measured>> runs(contenders.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            runs[i].push_back(contenders[i]());
        }
    }
    std::vector<Measured> medians;
    for (const std::vector<Measured>& of_one : runs) {
        medians.push_back({median(of_one, &Measured::cpu_seconds), median(of_one, &Measured::wall_seconds),
                           median(of_one, &Measured::peak_bytes), median(of_one, &Measured::note)});
    }
    return medians;
}

}  // namespace tinwright_benchmarks
