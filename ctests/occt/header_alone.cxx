// The header says all that it needs.
#include <footpoint_occt.hxx>
#include <footpoint_occt_faces.hxx>
