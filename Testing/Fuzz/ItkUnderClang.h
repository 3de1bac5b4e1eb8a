// Included before all else where Clang builds the fuzzers: Debian's ITK knows only the compiler
// that it was built with, GCC 12, and refuses any other by an #error in this one header.
#pragma once
#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#undef __clang__
#undef __GNUC__
#define __GNUC__ 12
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")
