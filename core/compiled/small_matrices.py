"""Products and roots of matrices too small for a call of BLAS, for the other compiled modules.

Each writes into an array that its caller gives; ``small_matrices.pxd`` says which types they take.
"""

import cython
from cython import Py_ssize_t, double
from cython.cimports.libc.math import sqrt


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_product(a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]) -> cython.void:
    """
    Add A B to ``out``.

    Two rows of A meet four of B at a time, so that each number is fetched less often; where all eight numbers of A are
    zero they are left out, also where those of B are not finite (:func:`zero_times`).
    """
    rows: Py_ssize_t = a.shape[0]
    columns: Py_ssize_t = b.shape[1]
    last: Py_ssize_t = a.shape[1] - a.shape[1] % 4
    for i in range(0, rows - 1, 2):
        for k in range(0, last, 4):
            w, x, y, z = a[i, k], a[i, k + 1], a[i, k + 2], a[i, k + 3]
            w2, x2, y2, z2 = a[i + 1, k], a[i + 1, k + 1], a[i + 1, k + 2], a[i + 1, k + 3]
            if w != 0.0 or x != 0.0 or y != 0.0 or z != 0.0 or w2 != 0.0 or x2 != 0.0 or y2 != 0.0 or z2 != 0.0:
                for j in range(columns):
                    p, q, r, s = b[k, j], b[k + 1, j], b[k + 2, j], b[k + 3, j]
                    out[i, j] += w * p + x * q + y * r + z * s
                    out[i + 1, j] += w2 * p + x2 * q + y2 * r + z2 * s
        for k in range(last, a.shape[1]):
            w, x = a[i, k], a[i + 1, k]
            if w != 0.0 or x != 0.0:
                for j in range(columns):
                    out[i, j] += w * b[k, j]
                    out[i + 1, j] += x * b[k, j]
    for i in range(rows - rows % 2, rows):
        for k in range(a.shape[1]):
            w = a[i, k]
            if w != 0.0:
                for j in range(columns):
                    out[i, j] += w * b[k, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def add_sparse_product(
    a: cython.const[double][:, ::1], b: cython.const[double][:, ::1], out: double[:, ::1]
) -> cython.void:
    """Add A B to ``out``, of an A that is mostly zeros: the rows of B that the others meet, four at a time."""
    last: Py_ssize_t = a.shape[1] - 1
    for i in range(a.shape[0]):
        p: Py_ssize_t = 0
        q: Py_ssize_t = 0
        r: Py_ssize_t = 0
        s: Py_ssize_t = 0
        w: double = 0.0
        x: double = 0.0
        y: double = 0.0
        z: double = 0.0
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
    """0, or NaN where any number of A is not finite: what a product that leaves out zeros must begin with, so that
    nothing unknown is passed over. Only the lower half of what is square is looked at."""
    # Four sums: one would wait for itself.
    w: double = 0.0
    x: double = 0.0
    y: double = 0.0
    z: double = 0.0
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
def inverse_root(root: double[:, ::1], inverse: double[:, ::1]) -> cython.bint:
    """L^-1 of a matrix L L', whose upper triangle is changed; False where it is not positive definite (Cholesky)."""
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
