/* The header needs nothing before it. Compiled as C99 and later, and as C++17 and later, with every warning an error. */
#include <footpoint.h>
