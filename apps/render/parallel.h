// Work on rows of a picture by several threads. Which thread does which row is chance; nothing that a row gives depends on it.
#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace brickfall::render {

// What `work` throws comes out here, the first of it, once all threads have ended.
template <class Work> void forRows(int rows, int threads, const Work& work) {
  std::atomic<int> next{0};
  std::mutex guard;
  std::exception_ptr thrown;
  const auto loop = [&] {
    try {
      for (int row = next++; row < rows; row = next++) work(row);
    } catch (...) {
      next = rows;  // the others begin no more
      const std::lock_guard lock(guard);
      if (!thrown) thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int i = 1; i < threads; i++) others.emplace_back(loop);
    } catch (const std::system_error&) {
      // The system gives no more of them: those that there are do all of the work.
    }
    loop();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace brickfall::render
