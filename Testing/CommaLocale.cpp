// Preloaded into programs that are tested under a decimal comma: puts them into the environment's
// locale from their first line on, for C and for C++, as a program that uses the modules may.

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
    catch (const std::runtime_error&) // there is none of that name
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
