#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "Script.h"

namespace standin
{

/// Simulated devices, connected or not, and the thread that plays the script.
class Bench
{
public:
  struct Device
  {
    unsigned short numbers[4] = {0, 0, 0, 0};
    std::wstring name;
    bool plugged = false;
    bool denied = false;
    bool failing = false; // the next read
    int opened = 0;
    int open = 0;
    unsigned generation = 0; // number of the connection; an open handle keeps the one it was opened
                             // in
    std::deque<std::vector<unsigned char>> reports;
  };

  ~Bench() { stop(); }

  void play(const std::vector<Command>& commands);
  void finish();
  void stop();
  void reset();

  /// Copies of the connected devices, by node.
  std::map<std::string, Device> plugged();

  /// Returns the generation opened; 0 if it cannot be opened.
  unsigned open(const std::string& node);
  void close(const std::string& node);
  int opened(const std::string& node);

  /// Like hid_read_timeout; milliseconds < 0 waits indefinitely.
  int read(const std::string& node, unsigned generation, unsigned char* bytes, std::size_t size,
           int milliseconds);

private:
  void run();
  void apply(const Command& command);

  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::map<std::string, Device> m_devices;
  std::deque<Command> m_commands;
  bool m_busy = false;
  bool m_stop = false;
  std::thread m_thread;
};

} // namespace standin
