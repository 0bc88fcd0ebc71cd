#include "solver/block_envelope.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace brickfall {

namespace {

typedef double Two __attribute__((vector_size(16)));

// Six numbers in three registers.
struct Six {
  Two a, b, c;
};
Six load(const double* from) {
  Six out;
  std::memcpy(&out, from, sizeof out);
  return out;
}
void store(const Six& v, double* to) { std::memcpy(to, &v, sizeof v); }
void takeScaled(Six& v, const Six& by, double share) {
  v.a -= by.a * share;
  v.b -= by.b * share;
  v.c -= by.c * share;
}
double dot(const Six& x, const Six& y) {
  Two sum = x.a * y.a + x.b * y.b + x.c * y.c;
  return sum[0] + sum[1];
}

}  // namespace

void BlockEnvelope::shape(const std::pmr::vector<std::uint32_t>& lowest) {
  lowest_.assign(lowest.begin(), lowest.end());
  begin_.resize(lowest.size());
  std::size_t count = 0;
  for (std::size_t row = 0; row < lowest.size(); row++) {
    begin_[row] = count;
    count += row - lowest[row] + 1;
  }
  blocks_.assign(count, Block{});
}

void BlockEnvelope::clear() { std::fill(blocks_.begin(), blocks_.end(), Block{}); }

void BlockEnvelope::add(std::size_t row, std::size_t column, const double (&b)[6][6]) {
  Block& to = at(row, column);
  for (int j = 0; j < 6; j++) {
    Six sum = load(to.column[j]);
    const Six more = load(b[j]);
    sum.a += more.a;
    sum.b += more.b;
    sum.c += more.c;
    store(sum, to.column[j]);
  }
}

void BlockEnvelope::stiffen(std::size_t row, unsigned rows, double times) {
  Block& block = at(row, row);
  for (int k = 0; k < 6; k++)
    if (rows >> k & 1) block.column[k][k] *= times;
}

// from -= the sum of left right^T over so many blocks. Three columns at a time stay in registers.
void BlockEnvelope::takeProducts(Block& from, const Block* left, const Block* right, std::size_t count) {
  for (int first = 0; first < 6; first += 3) {
    Six x = load(from.column[first]), y = load(from.column[first + 1]), z = load(from.column[first + 2]);
    for (std::size_t n = 0; n < count; n++)
      for (int k = 0; k < 6; k++) {
        const Six column = load(left[n].column[k]);
        const double* by = right[n].column[k] + first;
        takeScaled(x, column, by[0]);
        takeScaled(y, column, by[1]);
        takeScaled(z, column, by[2]);
      }
    store(x, from.column[first]);
    store(y, from.column[first + 1]);
    store(z, from.column[first + 2]);
  }
}

// On and under the diagonal: from -= left left^T
void BlockEnvelope::takeSquare(Block& from, const Block& left) {
  for (int j = 0; j < 6; j++) {
    Six sum = load(from.column[j]);
    for (int k = 0; k < 6; k++) {
      const Six column = load(left.column[k]);
      const double share = left.column[k][j];
      if (j < 2) sum.a -= column.a * share;
      if (j < 4) sum.b -= column.b * share;
      sum.c -= column.c * share;
    }
    store(sum, from.column[j]);
  }
}

// b := b L^-T, L on and under the diagonal of `diagonal`.
void BlockEnvelope::divideBy(Block& b, const Block& diagonal) {
  Six columns[6];
  for (int j = 0; j < 6; j++) {
    Six sum = load(b.column[j]);
    for (int k = 0; k < j; k++) takeScaled(sum, columns[k], diagonal.column[k][j]);
    const double inverse = diagonal.column[j][j];
    columns[j] = {sum.a * inverse, sum.b * inverse, sum.c * inverse};
    store(columns[j], b.column[j]);
  }
}

bool BlockEnvelope::factorDiagonal(Block& b) {
  Six columns[6];
  for (int j = 0; j < 6; j++) {
    Six sum = load(b.column[j]);
    for (int k = 0; k < j; k++) takeScaled(sum, columns[k], b.column[k][j]);
    store(sum, b.column[j]);
    const double pivot = b.column[j][j];
    if (!(pivot > 0)) return false;
    const double inverse = 1 / std::sqrt(pivot);
    columns[j] = {sum.a * inverse, sum.b * inverse, sum.c * inverse};
    store(columns[j], b.column[j]);
    b.column[j][j] = inverse;
  }
  return true;
}

bool BlockEnvelope::factor() {
  for (std::size_t row = 0; row < lowest_.size(); row++) {
    Block& diagonal = at(row, row);
    for (std::size_t j = lowest_[row]; j < row; j++) {
      Block& b = at(row, j);
      const std::size_t first = std::max(lowest_[row], lowest_[j]);
      if (first < j) takeProducts(b, &at(row, first), &at(j, first), j - first);
      divideBy(b, at(j, j));
      takeSquare(diagonal, b);
    }
    if (!factorDiagonal(diagonal)) return false;
  }
  return true;
}

void BlockEnvelope::solve(double* x) const {
  for (std::size_t row = 0; row < lowest_.size(); row++) {
    double* own = x + 6 * row;
    Six sum = load(own);
    for (std::size_t j = lowest_[row]; j < row; j++)
      for (int k = 0; k < 6; k++) takeScaled(sum, load(at(row, j).column[k]), x[6 * j + std::size_t(k)]);
    store(sum, own);
    const Block& diagonal = at(row, row);
    for (int k = 0; k < 6; k++) {
      own[k] *= diagonal.column[k][k];
      for (int i = k + 1; i < 6; i++) own[i] -= diagonal.column[k][i] * own[k];
    }
  }
  for (std::size_t row = lowest_.size(); row-- > 0;) {
    double* own = x + 6 * row;
    const Block& diagonal = at(row, row);
    for (int k = 5; k >= 0; k--) {
      for (int i = k + 1; i < 6; i++) own[k] -= diagonal.column[k][i] * own[i];
      own[k] *= diagonal.column[k][k];
    }
    const Six found = load(own);
    for (std::size_t j = lowest_[row]; j < row; j++)
      for (int k = 0; k < 6; k++) x[6 * j + std::size_t(k)] -= dot(load(at(row, j).column[k]), found);
  }
}

}  // namespace brickfall
