#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "OpenIgtLinkStream.h"
#include "ServerOptions.h"

namespace petrous::devices::testing
{

using Bytes = std::vector<unsigned char>;

// Messages written by OpenIGTLink 1.11 (igtl::TransformMessage, PositionMessage, StatusMessage).
// "Stylus" at (10.5, -20.25, 30), turned by a quarter about z; header version 1.
inline const char* const kTransform =
    "00015452414e53464f524d0000005374796c7573000000000000000000000000000000000000000000000000"
    "000000000030d014c90aa45f55be000000003f80000000000000bf8000000000000000000000000000000000"
    "00003f80000041280000c1a2000041f00000";
// "Stylus" at (1.5, -2.5, 3.5), likewise turned.
inline const char* const kPosition =
    "0001504f534954494f4e000000005374796c7573000000000000000000000000000000000000000000000000"
    "00000000001cdbaa2327b53c2f203fc00000c02000004060000000000000000000003f3504f33f3504f3";
inline const char* const kStatus =
    "0001535441545553000000000000446576696365000000000000000000000000000000000000000000000000"
    "00000000002410ce46c5d04dfcd1000100000000000000000a00000000000000000000000000000000000000"
    "726561647900";

inline Bytes bytesOf(const std::string& hex)
{
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<unsigned char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

inline void put(Bytes& bytes, std::size_t at, std::uint64_t value, int count)
{
  for (int i = count - 1; i >= 0; --i, value >>= 8U)
    bytes[at + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value);
}

// The message with header version 2: an extended header before its content (sizes of it and of the
// metadata, number of the message) and metadata behind.
inline Bytes withMetadata(const Bytes& message,
                          const std::vector<std::pair<std::string, std::string>>& entries = {
                              {"k", "vv"}})
{
  Bytes metadata(2 + 8 * entries.size());
  put(metadata, 0, entries.size(), 2);
  Bytes extended(12);
  put(extended, 0, 12, 2);
  put(extended, 2, metadata.size(), 2);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const auto& [key, value] = entries[i];
    put(metadata, 2 + 8 * i, key.size(), 2);
    put(metadata, 4 + 8 * i, 3, 2);
    put(metadata, 6 + 8 * i, value.size(), 4);
    metadata.insert(metadata.end(), key.begin(), key.end());
    metadata.insert(metadata.end(), value.begin(), value.end());
  }
  put(extended, 4, metadata.size() - 2 - 8 * entries.size(), 4);
  put(extended, 8, 7, 4);
  Bytes bytes = message;
  bytes.insert(bytes.begin() + 58, extended.begin(), extended.end());
  bytes.insert(bytes.end(), metadata.begin(), metadata.end());
  put(bytes, 0, 2, 2);
  put(bytes, 42, bytes.size() - 58, 8);
  put(bytes, 50, OpenIgtLinkStream::checksum(bytes.data() + 58, bytes.size() - 58), 8);
  return bytes;
}

// The message with these numbers, from number `first` of its body on.
inline Bytes with(const Bytes& message, std::size_t first, const std::vector<float>& numbers)
{
  Bytes bytes = message;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &numbers[i], sizeof bits);
    put(bytes, 58 + 4 * (first + i), bits, 4);
  }
  put(bytes, 50, OpenIgtLinkStream::checksum(bytes.data() + 58, bytes.size() - 58), 8);
  return bytes;
}

// A tracker that one program listens to.
class FakeTracker
{
public:
  FakeTracker()
    : m_listening(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(m_listening, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(m_listening, 4), 0);
    ::getsockname(m_listening, reinterpret_cast<sockaddr*>(&address), &size);
    m_port = ntohs(address.sin_port);
  }
  ~FakeTracker()
  {
    hangUp();
    ::close(m_listening);
  }
  FakeTracker(const FakeTracker&) = delete;
  FakeTracker& operator=(const FakeTracker&) = delete;

  ServedDevice::Options options(const std::string& name, std::vector<std::string> more = {}) const
  {
    ServedDevice::Options options = optionsFor(name);
    options.command = {PETROUS_OPENIGTLINK_SERVER, "--port", std::to_string(m_port)};
    options.command.insert(options.command.end(), more.begin(), more.end());
    return options;
  }

  void send(const Bytes& bytes)
  {
    if (m_client < 0)
      m_client = ::accept4(m_listening, nullptr, nullptr, SOCK_CLOEXEC);
    EXPECT_EQ(::send(m_client, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }

  void hangUp()
  {
    if (m_client >= 0)
      ::close(m_client);
    m_client = -1;
  }

private:
  int m_listening;
  int m_client = -1;
  int m_port = 0;
};

} // namespace petrous::devices::testing
