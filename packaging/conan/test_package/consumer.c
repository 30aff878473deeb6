/* The smallest program that needs the library: it is linked, and it is the one of this header. */
#include <footpoint.h>

int main(void) { return fpt_version() == FPT_VERSION && fpt_abi_version() == FPT_ABI_VERSION ? 0 : 1; }
