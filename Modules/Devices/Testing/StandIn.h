#pragma once

#include <memory>
#include <string>

#include <dlfcn.h>

#include <gtest/gtest.h>

#include "petrous/Devices/HidLibrary.h"

namespace petrous::devices::testing
{

/// Controls the stand-in hidapi for a test; starts and ends with nothing connected.
class StandIn
{
public:
  StandIn()
    : m_handle(::dlopen(PETROUS_STANDIN_HID_LIBRARY, RTLD_NOW | RTLD_LOCAL))
    , m_library(std::make_shared<const HidLibrary>(PETROUS_STANDIN_HID_LIBRARY))
  {
    function<void()>("standin_reset")();
  }
  ~StandIn()
  {
    function<void()>("standin_reset")();
    m_library.reset();
    ::dlclose(m_handle);
  }
  StandIn(const StandIn&) = delete;
  StandIn& operator=(const StandIn&) = delete;

  const std::shared_ptr<const HidLibrary>& library() const { return m_library; }

  /// Returns at once; the script plays concurrently.
  void play(const std::string& script)
  {
    ASSERT_EQ(function<int(const char*)>("standin_play")(script.c_str()), 0)
        << "a line of the script is wrong";
  }

  /// Plays the script to its end.
  void playAll(const std::string& script)
  {
    play(script);
    function<void()>("standin_finish")();
  }

  int opened(const std::string& node)
  {
    return function<int(const char*)>("standin_opened")(node.c_str());
  }

  int badLine(const std::string& script)
  {
    return function<int(const char*)>("standin_play")(script.c_str());
  }

private:
  template <typename Signature>
  Signature* function(const char* name)
  {
    return reinterpret_cast<Signature*>(::dlsym(m_handle, name));
  }

  void* m_handle;
  std::shared_ptr<const HidLibrary> m_library;
};

} // namespace petrous::devices::testing
