// Work in a child process that may crash or hang. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_WATCH_H
#define BENCH_WATCH_H

#include <atomic>
#include <cstddef>
#include <functional>

enum class End { DONE, CRASHED, HUNG, LATE };

// Of processor time, so that a busy machine is no part of it; a process that waits for ever ends after ten times as long.
struct Limits {
    // Without a change of the beat; until the first one twenty times as long.
    double silence_seconds = 1.5;
    // From the first beat on.
    double seconds = 4;
    size_t memory_bytes = size_t(6) << 30;
};

// Forks, runs `work` in the child, kills it when a limit is passed. `beat` lies in shared memory and is moved by the child.
// What the child prints is thrown away.
End watched(const std::function<void()> &work, const std::atomic<unsigned long> &beat, const Limits &limits);

// Zeroed memory that a child shares with its parent; kept until the end of the process.
void *shared_memory(size_t bytes);

#endif
