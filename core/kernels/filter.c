/* The filter's step: core/tracking/kernel.py in C. Covariances are symmetric: of what comes in the lower half is read. */
#include "algebra.h"
#include "filter.h"
#include "kernels.h"

static const double LEAST_PROBABILITY = 1e-6;

/* Probabilities (K) after log likelihoods; none ever falls to zero. */
static void reweighed(const double *before, const double *log_likelihood, double *out, int modes)
{
    double most = -INFINITY, sum = 0.0, again = 0.0;
    for (int k = 0; k < modes; k++) {
        out[k] = log(before[k]) + log_likelihood[k];
        if (!(out[k] <= most))
            most = out[k];
    }
    for (int k = 0; k < modes; k++)
        sum += out[k] = exp(out[k] - most);
    for (int k = 0; k < modes; k++) {
        out[k] /= sum;
        if (out[k] < LEAST_PROBABILITY)
            out[k] = LEAST_PROBABILITY;
        again += out[k];
    }
    for (int k = 0; k < modes; k++)
        out[k] /= again;
}

int corrected(
    int chains, int modes, int size, int count, const double *mean, const double *covariance, const double *probability,
    const double *value, const double *slope, const double *error, const double *about, const double *measured,
    const double *variance, const double *shared, const double *share,
    double *out_mean, double *out_covariance, double *out_probability, double *nis, int64_t *dof, double *residual)
{
    const int n = size, m = count, nn = n * n;
    double *work = malloc(sizeof(double) * (size_t)(4 * m * n + 3 * m * m + 4 * m + n + modes * (m + 2)));
    if (!work)
        return NO_MEMORY;
    double *tall = work, *across = tall + m * n, *cross = across + m * n, *white = cross + m * n,
           *own = white + m * n, *root = own + m * m, *inverse = root + m * m, *unit = inverse + m * m, *off = unit + m,
           *innovation = off + m, *apart = innovation + m, *line = apart + m, *each = line + n,
           *likelihood = each + modes * m, *square = likelihood + modes;
    int used[m > 0 ? m : 1], depends[m > 0 ? m : 1], failed = 0;
    for (int c = 0; c < chains && !failed; c++) {
        const double *expected = value + c * m, *seen = measured + c * m, *noise = variance + c * m;
        int u = 0;
        for (int i = 0; i < m; i++)
            if (isfinite(seen[i]))
                used[u++] = i;
        /* Those that depend on few numbers first: products skip what is zero in four rows at once. */
        for (int a = 0; a < u; a++) {
            const double *from = slope + (size_t)(c * m + used[a]) * n;
            depends[a] = 0;
            for (int j = 0; j < n; j++)
                depends[a] += from[j] != 0.0;
        }
        for (int a = 1; a < u; a++)
            for (int b = a; b > 0 && depends[b - 1] > depends[b]; b--) {
                const int i = used[b], d = depends[b];
                used[b] = used[b - 1], depends[b] = depends[b - 1];
                used[b - 1] = i, depends[b - 1] = d;
            }
        /* Everything in units of the noise; the slope (u, n), and turned (n, u). */
        for (int a = 0; a < u; a++) {
            unit[a] = 1.0 / sqrt(noise[used[a]]);
            off[a] = (seen[used[a]] - expected[used[a]]) * unit[a];
            const double *from = slope + (size_t)(c * m + used[a]) * n;
            for (int j = 0; j < n; j++)
                across[a * n + j] = tall[j * u + a] = from[j] * unit[a];
            for (int b = 0; b <= a; b++) {
                size_t at = (size_t)c * m * m + used[a] * m + used[b];
                own[a * u + b] = (error[at] + (shared ? shared[at] : 0.0)) * (unit[a] * unit[b]);
            }
            own[a * u + a] += 1.0;
        }
        for (int k = 0; k < modes; k++) {
            const double *at = mean + (c * modes + k) * n, *spread = covariance + (size_t)(c * modes + k) * nn;
            double *to = out_mean + (c * modes + k) * n, *wide = out_covariance + (size_t)(c * modes + k) * nn;
            for (int j = 0; j < n; j++)
                line[j] = at[j] - about[c * n + j];
            for (int a = 0; a < u; a++)
                innovation[a] = off[a] - dot(across + a * n, line, n);
            product(cross, n, across, n, 1, spread, n, u, n, n, SET);
            memcpy(root, own, sizeof(double) * (size_t)(u * u));
            product(root, u, cross, n, 1, tall, u, u, n, u, ADD | LOWER);
            failed = root_and_inverse(root, inverse, u);
            if (failed)
                break;
            product(white, n, inverse, u, 1, cross, n, u, u, n, SET);
            double log_root = 0.0, sum = 0.0;
            for (int a = 0; a < u; a++) {
                apart[a] = dot(inverse + a * u, innovation, a + 1);
                sum += apart[a] * apart[a];
                log_root -= log(inverse[a * u + a]);
            }
            square[k] = sum;
            likelihood[k] = -0.5 * sum - log_root;
            memset(line, 0, sizeof(double) * (size_t)n);
            for (int a = 0; a < u; a++)
                add_scaled(line, apart[a], white + a * n, n);
            for (int j = 0; j < n; j++)
                to[j] = at[j] + (share ? share[j] : 1.0) * line[j];
            product(wide, n, white, 1, n, white, n, n, u, n, SET | LOWER);
            for (int r = 0; r < n; r++) {
                double *row = wide + r * n;
                const double *before = spread + r * n;
                if (share)
                    for (int j = 0; j <= r; j++)
                        row[j] = before[j] - (share[r] + share[j] - share[r] * share[j]) * row[j];
                else
                    for (int j = 0; j <= r; j++)
                        row[j] = before[j] - row[j];
            }
            mirror(wide, n);
            double *surprise = each + k * m, length[u > 0 ? u : 1];
            memset(length, 0, sizeof length);
            memset(surprise, 0, sizeof(double) * (size_t)m);
            for (int b = 0; b < u; b++)
                for (int a = 0; a <= b; a++) {
                    surprise[a] += apart[b] * inverse[b * u + a];
                    length[a] += inverse[b * u + a] * inverse[b * u + a];
                }
            for (int a = 0; a < u; a++)
                surprise[a] /= sqrt(length[a]);
        }
        if (failed)
            break;
        double *weight = out_probability + c * modes, whole = 0.0;
        reweighed(probability + c * modes, likelihood, weight, modes);
        memset(residual + c * m, 0, (size_t)m * sizeof(double));
        for (int k = 0; k < modes; k++) {
            whole += weight[k] * square[k];
            for (int a = 0; a < u; a++)
                residual[c * m + used[a]] += weight[k] * each[k * m + a];
        }
        nis[c] = whole;
        dof[c] = u;
    }
    free(work);
    return failed;
}

/* Each mode's start from all that may have switched to it, `change` (K, K) from row to column. */
static void mixed(
    int modes, int n, const double *change, const double *mean, const double *covariance, const double *probability,
    double *out_mean, double *out_covariance, double *out_probability)
{
    const int nn = n * n;
    if (modes == 1 || !change) {
        memcpy(out_mean, mean, sizeof(double) * (size_t)(modes * n));
        memcpy(out_covariance, covariance, sizeof(double) * (size_t)modes * nn);
        memcpy(out_probability, probability, sizeof(double) * (size_t)modes);
        return;
    }
    double share[modes * modes], middle[n], apart[modes * n], shifted[modes * n], own[modes * n];
    for (int to = 0; to < modes; to++) {
        double sum = 0.0;
        for (int from = 0; from < modes; from++)
            sum += share[to * modes + from] = change[from * modes + to] * probability[from];
        for (int from = 0; from < modes; from++)
            share[to * modes + from] /= sum;
        out_probability[to] = sum;
    }
    /* The scatter of the means, about the first of them: sum of s (P + a a') less the square of sum of s a. */
    memcpy(middle, mean, sizeof middle);
    for (int from = 0; from < modes; from++)
        for (int j = 0; j < n; j++)
            apart[from * n + j] = mean[from * n + j] - middle[j];
    product(shifted, n, share, modes, 1, apart, n, modes, modes, n, SET);
    for (int to = 0; to < modes; to++)
        for (int j = 0; j < n; j++)
            out_mean[to * n + j] = middle[j] + shifted[to * n + j];
    for (int r = 0; r < n; r++) {
        double *row = out_covariance + r * n;
        for (int from = 0; from < modes; from++) {
            const double *before = covariance + (size_t)from * nn + r * n, *off = apart + from * n;
            for (int j = 0; j <= r; j++)
                own[from * n + j] = before[j] + off[r] * off[j];
        }
        product(row, nn, share, modes, 1, own, n, modes, modes, r + 1, SET);
        for (int to = 0; to < modes; to++)
            add_scaled(row + (size_t)to * nn, -shifted[to * n + r], shifted + to * n, r + 1);
    }
    for (int to = 0; to < modes; to++)
        mirror(out_covariance + (size_t)to * nn, n);
}

int merged(
    int chains, int modes, int size, const double *mean, const double *covariance, const double *probability,
    double *whole_mean, double *whole)
{
    const int n = size, nn = n * n;
    double apart[modes * n], weighed[modes * n];
    for (int c = 0; c < chains; c++) {
        const double *share = probability + c * modes, *first = mean + c * modes * n;
        double *middle = whole_mean + c * n, *out = whole + (size_t)c * nn;
        const double *each = covariance + (size_t)c * modes * nn;
        memset(middle, 0, sizeof(double) * (size_t)n);
        for (int k = 0; k < modes; k++)
            add_scaled(middle, share[k], first + k * n, n);
        for (int k = 0; k < modes; k++)
            for (int j = 0; j < n; j++) {
                apart[k * n + j] = first[k * n + j] - middle[j];
                weighed[k * n + j] = share[k] * apart[k * n + j];
            }
        for (int r = 0; r < n; r++) {
            double *row = out + r * n;
            memset(row, 0, sizeof(double) * (size_t)(r + 1));
            for (int k = 0; k < modes; k++) {
                const double *own = each + (size_t)k * nn + r * n, *off = apart + k * n, by = weighed[k * n + r];
                for (int j = 0; j <= r; j++)
                    row[j] += share[k] * own[j] + by * off[j];
            }
        }
        mirror(out, n);
    }
    return 0;
}

/* kernel.py, transitioned. */
void transitioned(
    int modes, int size, int mixing, int relaxing, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *moving, const double *driven, const double *kept, const double *stationary,
    const double *nominal, double *out_mean, double *out_covariance, double *out_probability)
{
    const int n = size, m = mixing, r = relaxing, nn = n * n, first = n - r;
    double rows[m * n], turned[m * m], moved[m > 0 ? m : 1];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            turned[i * m + j] = moving[j * m + i];
    mixed(modes, n, change, mean, covariance, probability, out_mean, out_covariance, out_probability);
    for (int k = 0; k < modes; k++) {
        double *at = out_mean + k * n, *wide = out_covariance + (size_t)k * nn;
        const double *left = kept + k * n;
        product(moved, m, at, n, 1, turned, m, 1, m, m, SET);
        for (int j = 0; j < n; j++)
            at[j] = at[j] * left[j] + (left[j] - 1.0) * nominal[j];
        memcpy(at, moved, sizeof(double) * (size_t)m);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                wide[i * n + j] *= left[i] * left[j];
        product(rows, n, moving, m, 1, wide, n, m, m, n, SET);
        for (int i = 0; i < m; i++) {
            memcpy(wide + i * n, driven + (k * m + i) * m, sizeof(double) * (size_t)m);
            memcpy(wide + i * n + m, rows + i * n + m, sizeof(double) * (size_t)(n - m));
        }
        for (int j = m; j < n; j++)
            for (int i = 0; i < m; i++)
                wide[j * n + i] = rows[i * n + j];
        product(wide, n, rows, n, 1, turned, m, m, m, m, ADD);
        for (int i = 0; i < r; i++)
            for (int j = 0; j < r; j++)
                wide[(first + i) * n + first + j] += stationary[(k * r + i) * r + j];
    }
}

/* kernel.py, predicted. */
void predicted(
    int chains, int modes, int size, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *forward, const double *noise, double *out_mean, double *out_covariance,
    double *out_probability)
{
    const int n = size, nn = n * n;
    double half[nn], turned[nn], before[n];
    for (int c = 0; c < chains; c++) {
        double *at = out_mean + c * modes * n, *wide = out_covariance + (size_t)c * modes * nn;
        const double *ahead = forward + (size_t)c * nn;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                turned[i * n + j] = ahead[j * n + i];
        mixed(modes, n, change, mean + c * modes * n, covariance + (size_t)c * modes * nn, probability + c * modes, at,
              wide, out_probability + c * modes);
        for (int k = 0; k < modes; k++, at += n, wide += nn) {
            memcpy(before, at, sizeof before);
            product(at, n, before, n, 1, turned, n, 1, n, n, SET);
            product(half, n, ahead, n, 1, wide, n, n, n, n, SET);
            memcpy(wide, noise + (size_t)(c * modes + k) * nn, sizeof(double) * (size_t)nn);
            product(wide, n, half, n, 1, turned, n, n, n, n, ADD);
        }
    }
}
