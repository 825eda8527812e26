#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

// What the leak sanitizer asks for by this name. GDAL 3.6 forgets the expat parser of a JML layer that it has
// read; none of our own code calls expat.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libexpat\n"; }
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
