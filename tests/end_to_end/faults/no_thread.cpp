// Loaded before a program: no thread can be started, as where `ulimit -u` is reached.
#include <cerrno>

extern "C" [[gnu::visibility("default")]] int pthread_create(void*, const void*, void* (*)(void*), void*) {
  return EAGAIN;
}
