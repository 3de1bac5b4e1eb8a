// Preloaded into programs under test with a decimal comma: sets the environment's locale for C and
// C++ before main, as a program using the modules may do.

#include <clocale>
#include <cstdio>
#include <cstring>
#include <locale>
#include <stdexcept>

#include <unistd.h>

namespace
{

struct CommaLocale
{
  CommaLocale()
  {
    try
    {
      std::locale::global(std::locale(""));
    }
    catch (const std::runtime_error&) // no such locale
    {
    }
    if (std::strcmp(std::localeconv()->decimal_point, ",") == 0)
      return;
    std::fputs("CommaLocale: LC_ALL names no locale with a decimal comma\n", stderr);
    ::_exit(99);
  }
};

const CommaLocale commaLocale;

} // namespace
