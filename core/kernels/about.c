/* What the loader asks before it trusts the library, once its last bytes have told that it is whole. */
#include "kernels.h"

const char *kernels_digest(void)
{
    return KERNELS_DIGEST;
}

int kernels_run_wide(void)
{
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return 0;
#endif
}
