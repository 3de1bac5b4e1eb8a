#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"

struct hid_device_;
struct hid_device_info;

namespace petrous::devices
{

/// hidapi, or a library that replaces it, cannot be used. The message names it.
class HidError : public core::Error
{
public:
  explicit HidError(const std::string& message);
};

/// One connected HID interface, as enumerated by hidapi.
struct HidInterface
{
  std::string path; ///< "/dev/hidraw3"
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string manufacturer;    ///< UTF-8, as reported by the device; may be empty
  std::string name;            ///< likewise
  std::uint16_t usagePage = 0; ///< 0 if unknown
  std::uint16_t usage = 0;
};

/// hidapi as a table of functions: the system's, or those of a shared library with the same C
/// interface (hidapi 0.13), by which tests simulate devices.
///
/// hidapi has global state for enumerating and opening devices, so these calls are serialised here;
/// create one library per program and share it. An open device belongs to one thread.
class HidLibrary
{
public:
  /// The system's hidapi, which is not loaded before its first use.
  HidLibrary();

  /// The shared library at `path`. Throws HidError naming it and what is missing.
  explicit HidLibrary(const std::string& path);

  ~HidLibrary();
  HidLibrary(const HidLibrary&) = delete;
  HidLibrary& operator=(const HidLibrary&) = delete;

  /// Connected interfaces, including those without permission to open them. Throws HidError if the
  /// system's hidapi cannot be loaded; so does `open`.
  std::vector<HidInterface> list() const;

  /// An open device; closed on destruction. Must not outlive its library.
  class Connection
  {
  public:
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Waits for a report. Returns its length, 0 on timeout, or a negative value if the device is
    /// gone.
    int read(unsigned char* bytes, std::size_t size, int milliseconds);

  private:
    friend class HidLibrary;
    Connection(const HidLibrary& library, hid_device_* device);
    const HidLibrary& m_library;
    hid_device_* m_device;
  };

  /// Returns nullptr if it cannot be opened.
  std::unique_ptr<Connection> open(const std::string& path) const;

private:
  struct Functions
  {
    int (*init)() = nullptr;
    int (*exit)() = nullptr;
    hid_device_info* (*enumerate)(unsigned short, unsigned short) = nullptr;
    void (*freeEnumeration)(hid_device_info*) = nullptr;
    hid_device_* (*openPath)(const char*) = nullptr;
    void (*close)(hid_device_*) = nullptr;
    int (*readTimeout)(hid_device_*, unsigned char*, std::size_t, int) = nullptr;
  };
  void load() const; // unless it is; with m_mutex held

  std::string m_path;
  mutable std::mutex m_mutex;
  mutable Functions m_functions;
  mutable void* m_handle = nullptr; // of the loaded library
};

} // namespace petrous::devices
