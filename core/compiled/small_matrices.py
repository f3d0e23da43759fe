"""Products and roots of matrices too small for a call of BLAS, for the other compiled modules.

Each writes into an array that its caller gives; ``small_matrices.pxd`` says which types they take.
"""

import cython
from cython import Py_ssize_t, double
from cython.cimports.libc.math import INFINITY, NAN, fabs, sqrt


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_product(a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]) -> cython.void:
    """Add A B to ``out``, of an A with zeros: the rows of B that the others meet, four at a time."""
    cython.declare(p=Py_ssize_t, q=Py_ssize_t, r=Py_ssize_t, s=Py_ssize_t, w=double, x=double, y=double, z=double)
    last: Py_ssize_t = a.shape[1] - 1
    for i in range(a.shape[0]):
        p = q = r = s = 0
        w = x = y = z = 0.0
        waiting: cython.int = 0
        for k in range(last + 1):
            if a[i, k] != 0.0:
                p, q, r, s = q, r, s, k
                w, x, y, z = x, y, z, a[i, k]
                waiting += 1
            if waiting == 4 or (waiting > 0 and k == last):
                for j in range(b.shape[1]):
                    out[i, j] += w * b[p, j] + x * b[q, j] + y * b[r, j] + z * b[s, j]
                w = x = y = z = 0.0
                waiting = 0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def zero_times(a: cython.const[double][:, ::1]) -> double:
    """Return 0, or NaN where any number in the lower half of A is not finite.

    What a product that leaves out zeros must begin with, so that nothing unknown is passed over.
    """
    unknown: Py_ssize_t = 0
    for i in range(a.shape[0]):
        for j in range(i + 1):
            unknown += not fabs(a[i, j]) < INFINITY
    return NAN if unknown else 0.0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def inverse_root(root: double[:, ::1], inverse: double[:, ::1]) -> cython.bint:
    """Compute L^-1 of a matrix L L' (Cholesky), of which L' is left in the upper triangle.

    Return False where it is not positive definite.
    """
    n: Py_ssize_t = root.shape[0]
    for i in range(n):
        for j in range(n):
            inverse[i, j] = 0.0
        inverse[i, i] = 1.0
    for k in range(n):
        if not root[k, k] > 0.0:
            return False
        by = 1.0 / sqrt(root[k, k])
        for j in range(k, n):
            root[k, j] *= by
        for j in range(k + 1):
            inverse[k, j] *= by
        for i in range(k + 1, n):
            x = root[k, i]
            if x != 0.0:
                for j in range(i, n):
                    root[i, j] -= x * root[k, j]
                for j in range(k + 1):
                    inverse[i, j] -= x * inverse[k, j]
    return True
