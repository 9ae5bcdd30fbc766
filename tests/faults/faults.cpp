// Makes calls of one program fail, loaded before its libraries (LD_PRELOAD):
//
//     TVBEAM_FAULT="write ENOSPC 7"    the seventh call of write() since main() began fails so, and
//     no other TVBEAM_FAULT="write ENOSPC 7+"   every later one, too: the disk stays full
//     TVBEAM_COUNTS=FILE               how many calls there were of each, one a line, when the
//     program ends
//
// Instead of an error: SHORT, half of what was asked for is read or written; KILL, the program is
// killed there. spawn stands for each step that is asked of a program before it starts; malloc
// stands for everything that reserves memory, and its error is no memory, whichever is named.

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

enum Call {
    calls_write,
    calls_fsync,
    calls_rename,
    calls_open,
    calls_read,
    calls_close,
    calls_fork,
    calls_spawn,
    calls_malloc,
    calls
};
constexpr const char* names[calls] = {"write", "fsync", "rename", "open",  "read",
                                      "close", "fork",  "spawn",  "malloc"};

struct NamedError {
    const char* name;
    int error;
};
constexpr int is_short = -1;
constexpr int is_kill = -2;
constexpr NamedError errors[] = {{"EIO", EIO},       {"ENOSPC", ENOSPC},  {"EINTR", EINTR},
                                 {"EMFILE", EMFILE}, {"EAGAIN", EAGAIN},  {"ENOMEM", ENOMEM},
                                 {"EACCES", EACCES}, {"SHORT", is_short}, {"KILL", is_kill}};

std::atomic<bool> in_main = false;
std::atomic<long> counts[calls];

// What is to fail; set before main() begins.
int faulty_call = calls;
int faulty_error = 0;
long faulty_from = 0;
bool faulty_after = false;

/// Counts a call, and returns the error that it is to give; 0: none.
int fault(Call call) {
    if (!in_main)
        return 0;
    const long number = ++counts[call];
    if (call != faulty_call || number < faulty_from || (number > faulty_from && !faulty_after))
        return 0;
    if (faulty_error == is_kill)
        raise(SIGKILL);
    return faulty_error;
}

/// Whether the call is to fail; then errno says why.
bool fails(Call call) {
    const int error = fault(call);
    if (error > 0)
        errno = error;
    return error > 0;
}

template <typename Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void read_fault() {
    const char* text = std::getenv("TVBEAM_FAULT");
    char call[16] = "";
    char error[16] = "";
    char after = ' ';
    if (text == nullptr ||
        std::sscanf(text, "%15s %15s %ld%c", call, error, &faulty_from, &after) < 3)
        return;
    for (const auto& known : errors)
        if (std::strcmp(known.name, error) == 0)
            faulty_error = known.error;
    faulty_after = after == '+';
    for (int i = 0; i < calls; ++i)
        if (std::strcmp(names[i], call) == 0)
            faulty_call = i;
}

int (*real_main)(int, char**, char**) = nullptr;

void write_counts() {
    in_main = false;
    const char* file = std::getenv("TVBEAM_COUNTS");
    FILE* stream = file == nullptr ? nullptr : std::fopen(file, "w");
    if (stream == nullptr)
        return;
    for (int i = 0; i < calls; ++i)
        std::fprintf(stream, "%s %ld\n", names[i], counts[i].load());
    std::fclose(stream);
}

int counted_main(int count, char** arguments, char** environment) {
    if (std::strcmp(program_invocation_short_name, "tvbeam") == 0) {
        read_fault();
        std::atexit(write_counts);
        in_main = true;
    }
    return real_main(count, arguments, environment);
}

} // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int count, char** arguments, void (*init)(),
                      void (*fini)(), void (*loader)(), void* stack) {
    real_main = main;
    return next<decltype(__libc_start_main)>("__libc_start_main")(counted_main, count, arguments,
                                                                  init, fini, loader, stack);
}

ssize_t write(int descriptor, const void* from, size_t size) {
    const int error = fault(calls_write);
    if (error > 0) {
        errno = error;
        return -1;
    }
    return syscall(SYS_write, descriptor, from, error == is_short ? (size + 1) / 2 : size);
}

ssize_t read(int descriptor, void* to, size_t size) {
    const int error = fault(calls_read);
    if (error > 0) {
        errno = error;
        return -1;
    }
    return syscall(SYS_read, descriptor, to, error == is_short ? (size + 1) / 2 : size);
}

int fsync(int descriptor) {
    return fails(calls_fsync) ? -1 : static_cast<int>(syscall(SYS_fsync, descriptor));
}

int fdatasync(int descriptor) {
    return fails(calls_fsync) ? -1 : static_cast<int>(syscall(SYS_fdatasync, descriptor));
}

int rename(const char* from, const char* to) {
    return fails(calls_rename)
               ? -1
               : static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int renameat2(int from_directory, const char* from, int to_directory, const char* to,
              unsigned flags) {
    return fails(calls_rename) ? -1
                               : static_cast<int>(syscall(SYS_renameat2, from_directory, from,
                                                          to_directory, to, flags));
}

int open(const char* path, int flags, ...) {
    mode_t mode = 0;
    if ((flags & O_CREAT) != 0) {
        va_list rest;
        va_start(rest, flags);
        mode = va_arg(rest, mode_t);
        va_end(rest);
    }
    return fails(calls_open) ? -1
                             : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) __attribute__((alias("open")));

// What fails to close is closed all the same.
int close(int descriptor) {
    const bool failed = fails(calls_close);
    const int error = errno;
    const auto closed = static_cast<int>(syscall(SYS_close, descriptor));
    if (!failed)
        return closed;
    errno = error;
    return -1;
}

int posix_spawnp(pid_t* process, const char* file, const posix_spawn_file_actions_t* actions,
                 const posix_spawnattr_t* attributes, char* const arguments[],
                 char* const environment[]) {
    if (fails(calls_fork))
        return errno;
    return next<decltype(posix_spawnp)>("posix_spawnp")(process, file, actions, attributes,
                                                        arguments, environment);
}

int posix_spawn_file_actions_addchdir_np(posix_spawn_file_actions_t* actions,
                                         const char* directory) {
    return fails(calls_spawn) ? errno
                              : next<decltype(posix_spawn_file_actions_addchdir_np)>(
                                    "posix_spawn_file_actions_addchdir_np")(actions, directory);
}

int posix_spawn_file_actions_addopen(posix_spawn_file_actions_t* actions, int descriptor,
                                     const char* path, int flags, mode_t mode) {
    return fails(calls_spawn)
               ? errno
               : next<decltype(posix_spawn_file_actions_addopen)>(
                     "posix_spawn_file_actions_addopen")(actions, descriptor, path, flags, mode);
}

int posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t* actions, int from, int to) {
    return fails(calls_spawn) ? errno
                              : next<decltype(posix_spawn_file_actions_adddup2)>(
                                    "posix_spawn_file_actions_adddup2")(actions, from, to);
}

void* malloc(size_t size) {
    return fails(calls_malloc) ? nullptr : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
    return fails(calls_malloc) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, size_t size) {
    return fails(calls_malloc) ? nullptr : __libc_realloc(memory, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
    return fails(calls_malloc) ? nullptr : __libc_memalign(alignment, size);
}

void* memalign(size_t alignment, size_t size) {
    return fails(calls_malloc) ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, size_t alignment, size_t size) {
    if (fails(calls_malloc))
        return ENOMEM;
    *memory = __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
}
