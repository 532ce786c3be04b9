// Row kernels of the conjugate gradients and of the bottom of the hierarchy. Included
// inside a namespace by kernels_table.cc.

static void dense(const unsigned int n,
                  const double *__restrict__ matrix,
                  const std::size_t stride,
                  const double *__restrict__ x,
                  double *__restrict__ y)
{
  const unsigned int whole = (n + 7) / 8 * 8;
  for (unsigned int i = 0; i < whole; ++i)
    y[i] = 0.;
  for (unsigned int j = 0; j < n; ++j)
    {
      const double factor               = x[j];
      const double *__restrict__ column = matrix + j * stride;
      for (unsigned int i = 0; i < whole; ++i)
        y[i] += factor * column[i];
    }
}

/** Sums run in 16 lanes that are added up in the end: the compiler may not reorder. */
static double add_up(const double *lanes)
{
  double sum = 0.;
  for (int l = 0; l < 16; ++l)
    sum += lanes[l];
  return sum;
}

static double dot(const std::size_t n, const double *a, const double *b)
{
  double sums[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      sums[l] += a[i + l] * b[i + l];
  return add_up(sums);
}

static double step(const std::size_t n,
                   const double alpha,
                   const double *__restrict__ p,
                   const double *__restrict__ q,
                   double *__restrict__ x,
                   double *__restrict__ r)
{
  double sums[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      {
        x[i + l] += alpha * p[i + l];
        const double v = r[i + l] - alpha * q[i + l];
        r[i + l]       = v;
        sums[l] += v * v;
      }
  return add_up(sums);
}

template <typename Number>
static void direction(const std::size_t n,
                      const double scale,
                      const double beta,
                      const Number *__restrict__ z,
                      double *__restrict__ p)
{
  for (std::size_t i = 0; i < n; ++i)
    p[i] = scale * static_cast<double>(z[i]) + beta * p[i];
}

template <typename Number>
static void scaled(const std::size_t n,
                   const double scale,
                   const double *__restrict__ x,
                   Number *__restrict__ y)
{
  for (std::size_t i = 0; i < n; ++i)
    y[i] = static_cast<Number>(scale * x[i]);
}

template <typename Number>
static void two_dots(const std::size_t n,
                     const double *__restrict__ r,
                     const double *__restrict__ q,
                     const Number *__restrict__ z,
                     double results[2])
{
  double rz[16] = {}, qz[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      {
        const double v = z[i + l];
        rz[l] += r[i + l] * v;
        qz[l] += q[i + l] * v;
      }
  results[0] = add_up(rz);
  results[1] = add_up(qz);
}

template <typename Number>
static void
subtract_from(const std::size_t n, const Number *__restrict__ b, Number *__restrict__ r)
{
  for (std::size_t i = 0; i < n; ++i)
    r[i] = b[i] - r[i];
}
