// Preloaded into the program, so that a test can have a system call of it fail, or end the program
// there (Modules/Core/Testing/SystemCalls.h). By environment variables:
//
//   PETROUS_KILL_AT=N          SIGKILL at the N-th call that changes files
//   PETROUS_FAIL=NAME:N:ERRNO  the N-th call of NAME fails
//   PETROUS_CALLS=FILE         the number of calls, and of those of NAME, goes to FILE at exit
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "../Modules/Core/Testing/SystemCalls.h"

namespace
{

using petrous::testing::SystemCalls;

int numberAt(const char* text)
{
  int number = 0;
  std::from_chars(text, text + std::strlen(text), number);
  return number;
}

struct Faults
{
  Faults()
  {
    if (const char* at = std::getenv("PETROUS_KILL_AT"))
      SystemCalls::killAt(numberAt(at));
    if (const char* text = std::getenv("PETROUS_FAIL"))
    {
      const std::string fault = text;
      const std::size_t first = fault.find(':');
      const std::size_t second = fault.find(':', first + 1);
      if (second != fault.npos)
        SystemCalls::fail(fault.substr(0, first), numberAt(fault.c_str() + first + 1),
                          numberAt(fault.c_str() + second + 1));
    }
  }
  ~Faults()
  {
    const int all = SystemCalls::count(), ofName = SystemCalls::countOfName();
    SystemCalls::reset();
    if (const char* name = std::getenv("PETROUS_CALLS"))
      if (std::FILE* file = std::fopen(name, "w"))
      {
        std::fprintf(file, "%d %d\n", all, ofName);
        std::fclose(file);
      }
  }
} faults;

} // namespace
