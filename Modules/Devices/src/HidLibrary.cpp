#include "petrous/Devices/HidLibrary.h"

#include <cwchar>

#include <dlfcn.h>
#include <hidapi.h>

namespace petrous::devices
{

namespace
{

std::string utf8(const wchar_t* text)
{
  std::string result;
  for (; text && *text; ++text)
  {
    const auto code = static_cast<std::uint32_t>(*text);
    const auto tail = [code](int shift)
    { return static_cast<char>(0x80U | ((code >> shift) & 0x3fU)); };
    if (code < 0x80)
      result += code < 0x20 ? ' ' : static_cast<char>(code);
    else if (code < 0x800)
      (result += static_cast<char>(0xc0U | (code >> 6))) += tail(0);
    else if (code < 0x10000)
      ((result += static_cast<char>(0xe0U | (code >> 12))) += tail(6)) += tail(0);
    else
      result += '?';
  }
  return result;
}

constexpr const char* kSystem = "libhidapi-hidraw.so.0";

struct Closer
{
  void operator()(void* handle) const { ::dlclose(handle); }
};

template <typename Function>
void find(void* handle, const std::string& library, const char* name, Function& function)
{
  function = reinterpret_cast<Function>(::dlsym(handle, name));
  if (!function)
    throw HidError(library + ": has no function " + name + ", which hidapi 0.13 has");
}

} // namespace

HidError::HidError(const std::string& message)
  : core::Error(core::Fault::Internal, message)
{
}

HidLibrary::HidLibrary()
  : m_path(kSystem)
{
}

HidLibrary::HidLibrary(const std::string& path)
  : m_path(path)
{
  load();
}

HidLibrary::~HidLibrary()
{
  if (!m_handle)
    return;
  m_functions.exit();
  ::dlclose(m_handle);
}

void HidLibrary::load() const
{
  if (m_handle)
    return;
  std::unique_ptr<void, Closer> handle(::dlopen(m_path.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!handle)
    throw HidError(m_path + ": cannot be loaded as hidapi: " + ::dlerror());
  find(handle.get(), m_path, "hid_init", m_functions.init);
  find(handle.get(), m_path, "hid_exit", m_functions.exit);
  find(handle.get(), m_path, "hid_enumerate", m_functions.enumerate);
  find(handle.get(), m_path, "hid_free_enumeration", m_functions.freeEnumeration);
  find(handle.get(), m_path, "hid_open_path", m_functions.openPath);
  find(handle.get(), m_path, "hid_close", m_functions.close);
  find(handle.get(), m_path, "hid_read_timeout", m_functions.readTimeout);
  if (m_functions.init() != 0)
    throw HidError(m_path + ": cannot be initialised");
  m_handle = handle.release();
}

std::vector<HidInterface> HidLibrary::list() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  load();
  std::vector<HidInterface> interfaces;
  hid_device_info* const first = m_functions.enumerate(0, 0);
  for (const hid_device_info* info = first; info; info = info->next)
    interfaces.push_back({info->path ? info->path : "", info->vendor_id, info->product_id,
                          utf8(info->manufacturer_string), utf8(info->product_string),
                          info->usage_page, info->usage});
  m_functions.freeEnumeration(first);
  return interfaces;
}

std::unique_ptr<HidLibrary::Connection> HidLibrary::open(const std::string& path) const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  load();
  hid_device_* device = m_functions.openPath(path.c_str());
  if (!device)
    return nullptr;
  return std::unique_ptr<Connection>(new Connection(*this, device));
}

HidLibrary::Connection::Connection(const HidLibrary& library, hid_device_* device)
  : m_library(library)
  , m_device(device)
{
}

HidLibrary::Connection::~Connection()
{
  const std::lock_guard<std::mutex> lock(m_library.m_mutex);
  m_library.m_functions.close(m_device);
}

int HidLibrary::Connection::read(unsigned char* bytes, std::size_t size, int milliseconds)
{
  return m_library.m_functions.readTimeout(m_device, bytes, size, milliseconds);
}

} // namespace petrous::devices
