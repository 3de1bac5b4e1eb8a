#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include <dlfcn.h>

namespace petrous::devices
{

/// A vendor's SDK, loaded at run time: a server is built without it, and says what is missing when
/// it is started (Documentation/adr/0030-device-servers.md).
class VendorLibrary
{
public:
  VendorLibrary() = default;
  VendorLibrary(const VendorLibrary&) = delete;
  VendorLibrary& operator=(const VendorLibrary&) = delete;
  ~VendorLibrary()
  {
    if (m_handle)
      ::dlclose(m_handle);
  }

  /// Loads `file`, or if that is empty the file named by environment variable `variable`, or else
  /// the first of `names` that the dynamic linker or one of `folders` has. False with problem().
  bool open(const std::string& file, const char* variable, const std::vector<std::string>& names,
            const std::vector<std::string>& folders)
  {
    if (m_handle)
      return true;
    std::string only = file;
    if (const char* named = std::getenv(variable); only.empty() && named)
      only = named;
    if (!only.empty())
    {
      m_handle = ::dlopen(only.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (!m_handle)
        m_problem = lastError(only + " cannot be loaded");
      return m_handle != nullptr;
    }
    for (const std::string& name : names)
    {
      m_handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      for (std::size_t i = 0; !m_handle && i < folders.size(); ++i)
        m_handle = ::dlopen((folders[i] + "/" + name).c_str(), RTLD_NOW | RTLD_LOCAL);
      if (m_handle)
        return true;
    }
    m_problem = "the vendor's library " + names.front() +
                " is not installed; where it lies elsewhere, " + variable + " names it";
    return false;
  }

  /// Sets `function` to the symbol; a missing one that is needed leaves a problem.
  template <typename Signature>
  void load(const char* name, Signature*& function, bool needed = true)
  {
    function = reinterpret_cast<Signature*>(::dlsym(m_handle, name));
    if (!function && needed)
      m_problem = std::string("the vendor's library has no function ") + name;
  }

  /// Empty if all is well.
  const std::string& problem() const noexcept { return m_problem; }

private:
  static std::string lastError(const std::string& fallback)
  {
    const char* text = ::dlerror();
    return text ? std::string(text) : fallback;
  }

  void* m_handle = nullptr;
  std::string m_problem;
};

} // namespace petrous::devices
