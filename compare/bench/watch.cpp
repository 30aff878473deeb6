// SPDX-License-Identifier: MIT OR Apache-2.0
#include "watch.h"

#include "clock.h"

#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

[[noreturn]] void run_child(const std::function<void()> &work, const Limits &limits) {
    const rlimit memory = {limits.memory_bytes, limits.memory_bytes}, no_core = {0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &no_core);
    // Should the parent go away, the child ends by itself.
    alarm(unsigned(10 * (limits.seconds + 21 * limits.silence_seconds)) + 10);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    try {
        work();
    } catch (...) {
        _exit(2);
    }
    _exit(0);
}

} // namespace

End watched(const std::function<void()> &work, const std::atomic<unsigned long> &beat, const Limits &limits) {
    const unsigned long at_first = beat;
    const pid_t process = fork();
    if (process == 0) {
        run_child(work, limits);
    }
    clockid_t processor;
    const bool known = clock_getcpuclockid(process, &processor) == 0;
    const double start = now();
    const auto spent = [&] { return std::max(known ? read_clock(processor) : 0.0, 0.1 * (now() - start)); };
    double begun = 0.0, heard = 0.0;
    for (unsigned long last = at_first;;) {
        int status = 0;
        if (waitpid(process, &status, WNOHANG) == process) {
            return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? End::DONE : End::CRASHED;
        }
        usleep(2000);
        const double time = spent();
        if (beat != last) {
            begun = last == at_first ? time : begun;
            last = beat;
            heard = time;
        }
        const bool started = last != at_first;
        const bool hung = time - heard > 1e9 * limits.silence_seconds * (started ? 1 : 20);
        const bool late = started && time - begun > 1e9 * limits.seconds;
        if (hung || late) {
            kill(process, SIGKILL);
            waitpid(process, nullptr, 0);
            return hung ? End::HUNG : End::LATE;
        }
    }
}

void *shared_memory(size_t bytes) {
    void *memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        throw std::runtime_error("no shared memory");
    }
    return memory;
}
