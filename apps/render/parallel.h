// Work on rows of a picture by several threads. Which thread does which row is chance; nothing that a row gives depends on it.
#pragma once
#include <atomic>
#include <thread>
#include <vector>

namespace brickfall::render {

template <class Work> void forRows(int rows, int threads, const Work& work) {
  std::atomic<int> next{0};
  const auto loop = [&] {
    for (int row = next++; row < rows; row = next++) work(row);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; i++) others.emplace_back(loop);
  loop();
  for (std::thread& other : others) other.join();
}

}  // namespace brickfall::render
