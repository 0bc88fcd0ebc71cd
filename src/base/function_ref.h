// A view of something callable: neither owns nor allocates, unlike std::function. For callbacks that are called before the
// call that takes them returns.
#pragma once
#include <memory>
#include <type_traits>
#include <utility>

namespace brickfall {

template <class Signature> class FunctionRef;

template <class R, class... A> class FunctionRef<R(A...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef> && std::is_invocable_r_v<R, F&, A...>)
      FunctionRef(F&& callable)
      : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* f, A... arguments) -> R {
          return (*static_cast<std::remove_reference_t<F>*>(f))(std::forward<A>(arguments)...);
        }) {}
  R operator()(A... arguments) const { return call_(callable_, std::forward<A>(arguments)...); }

 private:
  void* callable_;
  R (*call_)(void*, A...);
};

}  // namespace brickfall
