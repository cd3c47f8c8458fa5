#pragma once
// Values that host and device share: they lie in host memory, on a device, or in both, and go to
// where they are asked for. Copies of `Values` share them; whoever changes them has his own.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/pages.h"

namespace defray {

/// The device's side of values; opencl/device_values.h has it.
class DeviceValues {
 public:
  virtual ~DeviceValues() = default;
  /// Waits for the kernels that write the values and brings them to `host`, which is where the
  /// device works where it has no memory of its own.
  virtual void fetch(void* host) = 0;
};

template <typename T>
class Values {
 public:
  Values() : store_(std::make_shared<Store>()) {}
  Values(std::vector<T> values) : Values() {  // a vector is values in host memory
    store_->taken = std::move(values);
    store_->host = store_->taken.data();
    store_->count = store_->taken.size();
  }
  Values(std::initializer_list<T> values) : Values(std::vector<T>(values)) {}
  explicit Values(std::size_t count, T value = {}) : Values(std::vector<T>(count, value)) {}

  /// Somebody else's memory, which must stay alive and unchanged.
  static Values view(const T* host, std::size_t count) {
    Values v;
    v.store_->host = host;
    v.store_->count = count;
    return v;
  }

  /// Room for values that nobody has written yet.
  static Values room(std::size_t count) {
    Values v;
    v.store_->room = std::make_unique_for_overwrite<T[]>(count);
    v.store_->host = v.store_->room.get();
    v.store_->count = count;
    return v;
  }

  /// Values that only a device has.
  static Values on(std::unique_ptr<DeviceValues> device, std::size_t count) {
    Values v;
    v.store_->count = count;
    v.put(std::move(device));
    return v;
  }

  std::size_t size() const { return store_->count; }
  bool empty() const { return store_->count == 0; }

  /// In host memory.
  std::span<const T> host() const {
    if (!store_->is_on_host) store_->fetch();
    return {store_->host, store_->count};
  }
  const T& operator[](std::size_t i) const { return host()[i]; }
  const T& front() const { return host().front(); }
  const T& back() const { return host().back(); }
  const T* begin() const { return host().data(); }
  const T* end() const { return host().data() + size(); }

  /// In host memory, to be changed: no other copy of these values sees it.
  std::span<T> edit() {
    host();
    if (!is_own()) *this = Values(std::vector<T>(begin(), end()));
    store_->device.reset();
    return {const_cast<T*>(store_->host), store_->count};  // its own: see is_own
  }

  /// Nobody needs these values any more, while others stay; no kernel may be at work on them. Their
  /// memory goes back to the system.
  void give_back(std::size_t first, std::size_t how_many) {
    if (is_own() && store_->host) {
      give_back_pages(const_cast<T*>(store_->host + first), how_many * sizeof(T));
    }
  }

  /// As a vector; no copy where nobody else has them.
  std::vector<T> take() && {
    host();
    store_->device.reset();
    const bool is_vector = store_.use_count() == 1 && !store_->taken.empty();
    return is_vector ? std::move(store_->taken) : std::vector<T>(begin(), end());
  }

  /// The device's side, null if there is none.
  DeviceValues* device() const { return store_->device.get(); }

  /// A device has these values too, from now on.
  void share(std::unique_ptr<DeviceValues> device) const { store_->device = std::move(device); }

  /// From now on it is the device that knows them.
  void put(std::unique_ptr<DeviceValues> device) {
    store_->device = std::move(device);
    store_->is_on_host = false;
  }
  void written_by_device() { store_->is_on_host = false; }

  /// Whether this is the only copy, in memory of its own.
  bool is_own() const {
    const bool has_memory = !store_->taken.empty() || store_->room || !store_->is_on_host;
    return store_.use_count() == 1 && has_memory;
  }

  bool operator==(const Values& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  struct Store {
    std::vector<T> taken;
    std::unique_ptr<T[]> room;
    const T* host = nullptr;
    std::size_t count = 0;
    bool is_on_host = true;
    std::unique_ptr<DeviceValues> device;  // the last: it may work in the memory above

    void fetch() {
      if (!host) {
        room = std::make_unique_for_overwrite<T[]>(count);
        host = room.get();
      }
      device->fetch(const_cast<T*>(host));
      is_on_host = true;
    }
  };
  std::shared_ptr<Store> store_;
};

/// A flag, an index or a coverage for each pixel.
using Words = Values<std::uint32_t>;

/// Signed CoC radii, 1/256 px.
using Quanta = Values<std::int32_t>;

}  // namespace defray
