#include "StandInHid.h"

#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <fstream>
#include <sstream>

#include <hidapi.h>

#include "Bench.h"

// hidapi's functions have no object: the bench is the library's single global.
static standin::Bench& bench()
{
  static standin::Bench instance;
  return instance;
}

struct hid_device_
{
  std::string node;
  unsigned generation = 0;
  bool blocking = true;
};

namespace
{

wchar_t* copyOf(const std::wstring& text)
{
  return ::wcsdup(text.c_str());
}

const wchar_t kNoError[] = L"Success";

} // namespace

extern "C"
{

  int standin_play(const char* script)
  {
    int badLine = 0;
    const std::vector<standin::Command> commands = standin::parseScript(script, badLine);
    if (badLine == 0)
      bench().play(commands);
    return badLine;
  }

  void standin_finish(void)
  {
    bench().finish();
  }

  void standin_reset(void)
  {
    bench().reset();
  }

  int standin_opened(const char* node)
  {
    return bench().opened(node);
  }

  int hid_init(void)
  {
    const char* file = std::getenv("PETROUS_STANDIN_HID");
    if (!file)
      return 0;
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return stream && standin_play(text.str().c_str()) == 0 ? 0 : -1;
  }

  int hid_exit(void)
  {
    bench().stop();
    return 0;
  }

  hid_device_info* hid_enumerate(unsigned short vendor, unsigned short product)
  {
    hid_device_info* first = nullptr;
    hid_device_info** next = &first;
    for (const auto& [node, device] : bench().plugged())
    {
      if ((vendor != 0 && vendor != device.numbers[0]) ||
          (product != 0 && product != device.numbers[1]))
        continue;
      auto* info = static_cast<hid_device_info*>(std::calloc(1, sizeof(hid_device_info)));
      info->path = ::strdup(node.c_str());
      info->vendor_id = device.numbers[0];
      info->product_id = device.numbers[1];
      info->usage_page = device.numbers[2];
      info->usage = device.numbers[3];
      info->manufacturer_string = copyOf(L"Stand-in");
      info->product_string = copyOf(device.name);
      info->serial_number = copyOf(L"");
      info->interface_number = -1;
      *next = info;
      next = &info->next;
    }
    return first;
  }

  void hid_free_enumeration(hid_device_info* info)
  {
    while (info)
    {
      hid_device_info* const next = info->next;
      std::free(info->path);
      std::free(info->manufacturer_string);
      std::free(info->product_string);
      std::free(info->serial_number);
      std::free(info);
      info = next;
    }
  }

  hid_device* hid_open_path(const char* path)
  {
    const unsigned generation = bench().open(path);
    return generation != 0 ? new hid_device_{path, generation, true} : nullptr;
  }

  hid_device* hid_open(unsigned short vendor, unsigned short product, const wchar_t*)
  {
    for (const auto& [node, device] : bench().plugged())
      if (device.numbers[0] == vendor && device.numbers[1] == product)
        return hid_open_path(node.c_str());
    return nullptr;
  }

  void hid_close(hid_device* device)
  {
    if (!device)
      return;
    bench().close(device->node);
    delete device;
  }

  int hid_read_timeout(hid_device* device, unsigned char* data, size_t length, int milliseconds)
  {
    return bench().read(device->node, device->generation, data, length, milliseconds);
  }

  int hid_read(hid_device* device, unsigned char* data, size_t length)
  {
    return hid_read_timeout(device, data, length, device->blocking ? -1 : 0);
  }

  int hid_set_nonblocking(hid_device* device, int nonblock)
  {
    device->blocking = nonblock == 0;
    return 0;
  }

  int hid_write(hid_device*, const unsigned char*, size_t length)
  {
    return static_cast<int>(length);
  }

  int hid_send_feature_report(hid_device*, const unsigned char*, size_t length)
  {
    return static_cast<int>(length);
  }

  int hid_get_feature_report(hid_device*, unsigned char*, size_t)
  {
    return -1;
  }

  int hid_get_input_report(hid_device*, unsigned char*, size_t)
  {
    return -1;
  }

  int hid_get_manufacturer_string(hid_device*, wchar_t* string, size_t size)
  {
    return std::swprintf(string, size, L"Stand-in") < 0 ? -1 : 0;
  }

  int hid_get_product_string(hid_device*, wchar_t* string, size_t size)
  {
    return std::swprintf(string, size, L"Stand-in") < 0 ? -1 : 0;
  }

  int hid_get_serial_number_string(hid_device*, wchar_t* string, size_t size)
  {
    return size > 0 ? (string[0] = L'\0', 0) : -1;
  }

  int hid_get_indexed_string(hid_device*, int, wchar_t*, size_t)
  {
    return -1;
  }

  hid_device_info* hid_get_device_info(hid_device*)
  {
    return nullptr;
  }

  const wchar_t* hid_error(hid_device*)
  {
    return kNoError;
  }

  const hid_api_version* hid_version(void)
  {
    static const hid_api_version version = {0, 13, 1};
    return &version;
  }

  const char* hid_version_str(void)
  {
    return "0.13.1 (stand-in)";
  }

} // extern "C"
