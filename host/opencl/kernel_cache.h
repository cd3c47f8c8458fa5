#pragma once
// PoCL's on-disk kernel cache.

namespace defray {

/// Makes sure that PoCL can write its kernel cache: with an unwritable one it offers no device at
/// all, and says nothing. Falls back to a private folder, removed when the program ends.
/// After it no OpenCL call moves the process's environment variables. Must run before the first
/// one and before there are other threads; later calls do nothing.
void prepare_environment();

/// While it lives no other process of ours builds a program: PoCL loses a race when several fill
/// its cache (github.com/pocl/pocl/issues/1480). Waits; does nothing where there can be no lock.
class KernelCacheLock {
 public:
  KernelCacheLock();
  ~KernelCacheLock();
  KernelCacheLock(const KernelCacheLock&) = delete;
  KernelCacheLock& operator=(const KernelCacheLock&) = delete;

 private:
  int file_;
};

}  // namespace defray
