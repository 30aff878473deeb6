// The C++ layer needs nothing before it.
#include <footpoint.hpp>
