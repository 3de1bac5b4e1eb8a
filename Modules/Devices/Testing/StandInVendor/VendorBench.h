#pragma once

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "../ServerOptions.h"
#include "StandInDevice.h"

namespace petrous::devices::testing
{

/// A vendor's device server, and the stand-in of what it talks to.
struct Vendor
{
  const char* name;
  const char* program;
  const char* library;                     // empty: a service
  const char* service;                     // empty: a library
  double unit;                             // mm
  std::atomic<int> StandInDevice::*forces; // set to `off`, forces do not work
  int off;
  const char* advice; // then
};

inline void PrintTo(const Vendor& vendor, std::ostream* out)
{
  *out << vendor.name;
}

inline const Vendor kForceDimension = {"ForceDimension",
                                       PETROUS_FORCE_DIMENSION_SERVER,
                                       PETROUS_STANDIN_DHD_LIBRARY,
                                       "",
                                       1000.0,
                                       &StandInDevice::forceOff,
                                       1,
                                       "press the force button"};
inline const Vendor kTouch = {
    "Touch", PETROUS_TOUCH_SERVER, PETROUS_STANDIN_HD_LIBRARY, "", 1.0, &StandInDevice::forceOff,
    1,       "disabled them"};
#ifdef PETROUS_INVERSE3_SERVER
inline const Vendor kInverse3 = {"Inverse3", PETROUS_INVERSE3_SERVER, "", PETROUS_STANDIN_INVERSE3,
                                 1000.0,     &StandInDevice::powered, 0,  "power supply"};
#endif

/// The stand-in of a vendor's device and what its server is started with.
class VendorBench
{
public:
  explicit VendorBench(const Vendor& vendor)
    : m_path(::testing::TempDir() + "petrous-standin-" + std::to_string(::getpid()))
    , m_device(mapStandIn(m_path, true))
    , m_vendor(vendor)
  {
    ::setenv(StandInDevice::kVariable, m_path.c_str(), 1);
  }
  ~VendorBench()
  {
    if (m_service)
      ::pclose(m_service); // ends it
    ::unsetenv(StandInDevice::kVariable);
    ::munmap(m_device, sizeof(StandInDevice));
    ::unlink(m_path.c_str());
  }
  VendorBench(const VendorBench&) = delete;
  VendorBench& operator=(const VendorBench&) = delete;

  StandInDevice* operator->() const { return m_device; }

  std::vector<std::string> command()
  {
    if (*m_vendor.library)
      return {m_vendor.program, "--sdk", m_vendor.library};
    if (!m_service)
      m_service = ::popen(("exec " + std::string(m_vendor.service)).c_str(), "w");
    EXPECT_TRUE(eventually([this] { return m_device->port != 0; }));
    return {m_vendor.program, "--url", "ws://127.0.0.1:" + std::to_string(m_device->port.load())};
  }

  ServedDevice::Options options(const std::string& name)
  {
    ServedDevice::Options options = optionsFor(name);
    options.command = command();
    return options;
  }

  bool forceIs(double x, double y, double z) const
  {
    return std::abs(m_device->force[0] - x) + std::abs(m_device->force[1] - y) +
               std::abs(m_device->force[2] - z) <
           1e-9;
  }

private:
  std::string m_path;
  StandInDevice* m_device;
  const Vendor& m_vendor;
  std::FILE* m_service = nullptr;
};

} // namespace petrous::devices::testing
