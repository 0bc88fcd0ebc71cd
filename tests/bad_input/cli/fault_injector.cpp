// Preloaded into the command (LD_PRELOAD): lets the n-th call that touches a file fail, or the process die in it.
// BRICKFALL_FAULT is "n kind", kind being an errno or "kill"; a write first takes half of its bytes. Which call it was is
// written to the file BRICKFALL_FAULT_LOG.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

int calls = 0;
std::FILE* failedStream = nullptr;

template <class F> F next(const char* name) { return reinterpret_cast<F>(dlsym(RTLD_NEXT, name)); }

// The errno to fail with; 0: go on; -1: die.
int faultIn(const char* call) {
  const char* plan = std::getenv("BRICKFALL_FAULT");
  const char* log = std::getenv("BRICKFALL_FAULT_LOG");
  if (plan == nullptr || log == nullptr || ++calls != std::atoi(plan)) return 0;
  const int file = int(syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_TRUNC, 0644));
  syscall(SYS_write, file, call, std::strlen(call));
  syscall(SYS_close, file);
  const char* kind = std::strchr(plan, ' ') + 1;
  return std::strcmp(kind, "kill") == 0 ? -1 : std::atoi(kind);
}

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

// True: fail, errno is set.
bool fails(const char* call) {
  const int fault = faultIn(call);
  if (fault < 0) die();
  if (fault > 0) errno = fault;
  return fault > 0;
}

int openFile(const char* name, const char* path, int flags, unsigned mode) {
  const bool libraries = std::strncmp(path, "/dev/", 5) == 0 || std::strncmp(path, "/proc/", 6) == 0;
  if (!libraries && fails("open")) return -1;
  return next<int (*)(const char*, int, unsigned)>(name)(path, flags, mode);
}

unsigned modeOf(int flags, va_list rest) { return (flags & O_CREAT) != 0 ? va_arg(rest, unsigned) : 0; }

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const unsigned mode = modeOf(flags, rest);
  va_end(rest);
  return openFile("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const unsigned mode = modeOf(flags, rest);
  va_end(rest);
  return openFile("open64", path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  return fails("fopen") ? nullptr : next<FILE* (*)(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  return fails("fopen") ? nullptr : next<FILE* (*)(const char*, const char*)>("fopen64")(path, mode);
}

ssize_t write(int file, const void* bytes, size_t count) {
  const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (file <= STDERR_FILENO) return real(file, bytes, count);
  const int fault = faultIn("write");
  if (fault == 0) return real(file, bytes, count);
  // A disk that fills takes what fits and refuses the rest. A call is one, so what the caller sees is the refusal.
  if (real(file, bytes, count / 2) < 0) return -1;
  if (fault < 0) die();
  errno = fault;
  return -1;
}

ssize_t read(int file, void* bytes, size_t count) {
  return fails("read") ? -1 : next<ssize_t (*)(int, void*, size_t)>("read")(file, bytes, count);
}

size_t fread(void* bytes, size_t size, size_t count, FILE* stream) {
  const auto real = next<size_t (*)(void*, size_t, size_t, FILE*)>("fread");
  const int fault = faultIn("fread");
  if (fault == 0) return real(bytes, size, count, stream);
  if (fault < 0) die();
  const size_t half = real(bytes, size, count / 2, stream);
  failedStream = stream;
  errno = fault;
  return half;
}

int ferror(FILE* stream) {
  return stream != nullptr && stream == failedStream ? 1 : next<int (*)(FILE*)>("ferror")(stream);
}

int fsync(int file) { return fails("fsync") ? -1 : next<int (*)(int)>("fsync")(file); }
int ftruncate(int file, off_t size) {
  return fails("ftruncate") ? -1 : next<int (*)(int, off_t)>("ftruncate")(file, size);
}
int rename(const char* from, const char* to) {
  return fails("rename") ? -1 : next<int (*)(const char*, const char*)>("rename")(from, to);
}
int mkdir(const char* path, mode_t mode) {
  return fails("mkdir") ? -1 : next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
