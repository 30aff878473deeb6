//! Small dense equations: positive definite matrices by Cholesky's method.

/// Solves `A y = b` in place of `b` for a symmetric `A` of `n` rows, of which `A + ridge trace(A)/n` is positive definite. `a` is
/// overwritten by the factor. False when even that is not: then nothing can be said.
pub fn solve(a: &mut [f64], b: &mut [f64], ridge: f64) -> bool {
    let n = b.len();
    let trace: f64 = (0..n).map(|i| a[i * n + i]).sum();
    if n == 0 {
        return true;
    }
    if !trace.is_finite() || trace <= 0.0 {
        return false;
    }
    for i in 0..n {
        a[i * n + i] += ridge * trace / n as f64;
    }
    for j in 0..n {
        for i in j..n {
            let sum: f64 = (0..j).map(|k| a[i * n + k] * a[j * n + k]).sum();
            let rest = a[i * n + j] - sum;
            if i > j {
                a[i * n + j] = rest / a[j * n + j];
            } else if rest > 0.0 {
                a[j * n + j] = rest.sqrt();
            } else {
                return false;
            }
        }
    }
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| a[i * n + k] * b[k]).sum();
        b[i] = (b[i] - sum) / a[i * n + i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| a[k * n + i] * b[k]).sum();
        b[i] = (b[i] - sum) / a[i * n + i];
    }
    b.iter().all(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_satisfies_its_equations() {
        let a = [4.0, 2.0, 1.0, 2.0, 5.0, 3.0, 1.0, 3.0, 6.0];
        let mut b = [1.0, -2.0, 3.0];
        assert!(solve(&mut a.clone(), &mut b, 0.0));
        for (row, wanted) in a.chunks(3).zip([1.0, -2.0, 3.0]) {
            let sum: f64 = row.iter().zip(&b).map(|(x, y)| x * y).sum();
            assert!((sum - wanted).abs() < 1e-14);
        }
    }

    #[test]
    fn a_singular_matrix_is_refused_without_a_ridge() {
        let a = [1.0, 1.0, 1.0, 1.0];
        assert!(!solve(&mut a.clone(), &mut [1.0, 1.0], 0.0));
        let mut b = [1.0, 1.0];
        assert!(solve(&mut a.clone(), &mut b, 1e-12));
        assert!((b[0] - 0.5).abs() < 1e-6 && (b[1] - 0.5).abs() < 1e-6);
        assert!(!solve(&mut [0.0], &mut [1.0], 1e-12));
    }
}
