#include "DeviceBlock.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "petrous/Core/OpenedLock.h"
#include "petrous/Devices/DeviceServerExchange.h"
#include "petrous/Devices/ServedDevice.h"

namespace petrous::devices
{

namespace
{

std::string pathOf(const std::string& name)
{
  static constexpr char kAllowed[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  if (name.empty() || name.size() > 48 || name.find_first_not_of(kAllowed) != std::string::npos)
    throw core::InvalidParameter("device server '" + name +
                                 "': a name has 1 to 48 letters, digits, '.', '-' or '_'");
  return "/petrous-device-" + name;
}

ServerError cannotMake(const std::string& name, const std::string& path)
{
  return {ServerError::Reason::NotStarted, "device server '" + name +
                                               "': cannot make the shared memory " + path + ": " +
                                               std::strerror(errno)};
}

} // namespace

DeviceBlock::DeviceBlock(const std::string& name)
  : m_path(pathOf(name))
{
  removeLeftover(name);
  m_file = ::shm_open(m_path.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  if (m_file < 0)
    throw cannotMake(name, m_path);
  void* memory = MAP_FAILED;
  if (core::lockOpened(m_file) == core::LockState::Ours &&
      ::ftruncate(m_file, sizeof(petrous_device_block)) == 0)
    memory = ::mmap(nullptr, sizeof(petrous_device_block), PROT_READ | PROT_WRITE, MAP_SHARED,
                    m_file, 0);
  if (memory == MAP_FAILED)
  {
    const ServerError error = cannotMake(name, m_path);
    ::shm_unlink(m_path.c_str());
    ::close(m_file);
    throw error;
  }
  m_block = static_cast<petrous_device_block*>(memory);
  __atomic_store_n(&m_block->version, PETROUS_DEVICE_VERSION, __ATOMIC_RELAXED);
  __atomic_store_n(&m_block->size, sizeof(petrous_device_block), __ATOMIC_RELAXED);
  __atomic_store_n(&m_block->petrous_pid, static_cast<std::uint32_t>(::getpid()), __ATOMIC_RELAXED);
  __atomic_store_n(&m_block->petrous_state, std::uint32_t{PETROUS_RUNNING}, __ATOMIC_RELAXED);
  __atomic_store_n(&m_block->magic, PETROUS_DEVICE_MAGIC, __ATOMIC_RELEASE);
}

DeviceBlock::~DeviceBlock()
{
  ::shm_unlink(m_path.c_str());
  ::munmap(m_block, sizeof(petrous_device_block));
  ::close(m_file);
}

void DeviceBlock::removeLeftover(const std::string& name)
{
  const int file = ::shm_open(m_path.c_str(), O_RDWR, 0);
  if (file < 0)
    return;
  const bool free = core::lockOpened(file) == core::LockState::Ours;
  if (free)
    ::shm_unlink(m_path.c_str());
  ::close(file);
  if (!free)
    throw ServerError(ServerError::Reason::InUse,
                      "device server '" + name + "': in use by another Petrous, which has locked " +
                          m_path);
}

void DeviceBlock::forgetServer() noexcept
{
  petrous_device_block& block = *m_block;
  __atomic_store_n(&block.server_state, std::uint32_t{PETROUS_SERVER_EMPTY}, __ATOMIC_RELEASE);
  __atomic_store_n(&block.server_version, 0U, __ATOMIC_RELAXED);
  __atomic_store_n(&block.server_pid, 0U, __ATOMIC_RELAXED);
  __atomic_store_n(&block.flags, 0U, __ATOMIC_RELAXED);
  petrous_device_text(block.name, sizeof block.name, "");
  petrous_device_text(block.error, sizeof block.error, "");
}

} // namespace petrous::devices
