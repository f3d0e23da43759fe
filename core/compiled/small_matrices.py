"""Products and roots of matrices too small for a call of BLAS, for the other compiled modules.

Each writes into an array that its caller gives; ``small_matrices.pxd`` says which types they take.
"""

import cython
from cython.cimports.libc.math import sqrt


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_product(
    a: cython.const[cython.double][:, ::1], b: cython.const[cython.double][:, ::1], out: cython.double[:, ::1]
) -> cython.void:
    """``out`` += A B. Four rows of B at a time, so that a row of ``out`` is fetched a quarter as often; those that only
    zeros of A meet are left out, also where they are not finite (:func:`zero_times`)."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    columns: cython.Py_ssize_t = b.shape[1]
    last: cython.Py_ssize_t = a.shape[1] - a.shape[1] % 4
    for i in range(a.shape[0]):
        for k in range(0, last, 4):
            w, x, y, z = a[i, k], a[i, k + 1], a[i, k + 2], a[i, k + 3]
            if w != 0.0 or x != 0.0 or y != 0.0 or z != 0.0:
                for j in range(columns):
                    out[i, j] += w * b[k, j] + x * b[k + 1, j] + y * b[k + 2, j] + z * b[k + 3, j]
        for k in range(last, a.shape[1]):
            x = a[i, k]
            if x != 0.0:
                for j in range(columns):
                    out[i, j] += x * b[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_square(a: cython.const[cython.double][:, ::1], out: cython.double[:, ::1]) -> cython.void:
    """``out`` += A' A, the lower half; four rows of A at a time: a row of ``out`` is fetched a quarter as often."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    last: cython.Py_ssize_t = a.shape[0] - a.shape[0] % 4
    for i in range(a.shape[1]):
        for k in range(0, last, 4):
            w, x, y, z = a[k, i], a[k + 1, i], a[k + 2, i], a[k + 3, i]
            for j in range(i + 1):
                out[i, j] += w * a[k, j] + x * a[k + 1, j] + y * a[k + 2, j] + z * a[k + 3, j]
        for k in range(last, a.shape[0]):
            x = a[k, i]
            for j in range(i + 1):
                out[i, j] += x * a[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def zero_times(a: cython.const[cython.double][:, ::1]) -> cython.double:
    """0, or NaN where any number of A is not finite: what a product that leaves out zeros must begin with, so that
    nothing unknown is passed over. Only the lower half of what is square is looked at."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    # Four sums: one would wait for itself.
    w: cython.double = 0.0
    x: cython.double = 0.0
    y: cython.double = 0.0
    z: cython.double = 0.0
    for i in range(a.shape[0]):
        j = 0
        while j + 3 <= i:
            w += 0.0 * a[i, j]
            x += 0.0 * a[i, j + 1]
            y += 0.0 * a[i, j + 2]
            z += 0.0 * a[i, j + 3]
            j += 4
        while j <= i:
            w += 0.0 * a[i, j]
            j += 1
    return w + x + y + z


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def inverse_root(root: cython.double[:, ::1], inverse: cython.double[:, ::1]) -> cython.bint:
    """L^-1 of a matrix L L', whose upper triangle is changed; False where it is not positive definite (Cholesky)."""
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    n: cython.Py_ssize_t = root.shape[0]
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
