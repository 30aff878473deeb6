// The header says all that it needs.
#include <footpoint_occt.hxx>
