# One CMake target per module. A module sees its own headers as "module/file.h" and those of the modules that it names,
# through a folder of links made for it: an include that the layer table (docs/architecture.md) forbids does not compile.

# The same bits everywhere: no fused multiply-add, nothing that trades exactness for speed.
add_library(brickfall_options INTERFACE)
target_compile_options(brickfall_options INTERFACE
  -ffp-contract=off -fno-math-errno -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
if(BRICKFALL_WERROR)
  target_compile_options(brickfall_options INTERFACE -Werror)
endif()
# What g++ 12 says wrongly: of strings, more often at -O3, and of what sanitizers put in.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(BRICKFALL_DOUBTS -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
  if(BRICKFALL_SANITIZE)
    target_compile_options(brickfall_options INTERFACE ${BRICKFALL_DOUBTS})
  endif()
endif()
# g++ 12 fuses pairs of products into vfmaddsub all the same (its vectoriser does not ask -ffp-contract) where the flags of
# the build, such as -march=native, allow it: the instructions have to go, those of AVX-512 too, which bring their own.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#ifndef __FMA__\n#error none\n#endif\nint main() {}" BRICKFALL_BUILD_HAS_FMA)
if(BRICKFALL_BUILD_HAS_FMA)
  target_compile_options(brickfall_options INTERFACE -mno-fma -mno-avx512f)
endif()
target_include_directories(brickfall_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
if(BRICKFALL_ASSERTS)
  target_compile_definitions(brickfall_options INTERFACE $<BUILD_INTERFACE:BRICKFALL_ASSERTS=1>)
endif()
if(BRICKFALL_SANITIZE)
  target_compile_options(brickfall_options INTERFACE -fsanitize=${BRICKFALL_SANITIZE}
    -fno-sanitize=${BRICKFALL_SANITIZE_NOT} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(brickfall_options INTERFACE -fsanitize=${BRICKFALL_SANITIZE})
endif()

# brickfall_glue(TARGET): what reads, words and shows is waited for by nobody but who compiles it: a third less of that at -O1.
function(brickfall_glue target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# brickfall_module(NAME [ENGINE] SOURCES ... [ALONE source ...] USES module ... LINK library ...)
# ENGINE: neither throws nor needs exceptions.
# ALONE: of SOURCES, those that cannot share a file with the others (mostly, names that another has for something else): left
# alone where the module is compiled as one file (BRICKFALL_UNITY, tests/fuzz, the variants of tests/determinism).
function(brickfall_module name)
  cmake_parse_arguments(ARG "ENGINE" "" "SOURCES;ALONE;USES;LINK" ${ARGN})
  set_source_files_properties(${ARG_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set(links ${CMAKE_BINARY_DIR}/modules/${name})
  file(MAKE_DIRECTORY ${links})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${links}/${name} SYMBOLIC)
  if(ARG_SOURCES)
    add_library(bf_${name} OBJECT ${ARG_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(bf_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_link_libraries(bf_${name} ${scope} brickfall_options ${ARG_LINK})
  target_include_directories(bf_${name} ${scope} $<BUILD_INTERFACE:${links}>)
  if(ARG_ENGINE AND ARG_SOURCES)
    target_compile_options(bf_${name} PRIVATE -fno-exceptions -fno-rtti)
  endif()
  if(BRICKFALL_UNITY AND ARG_SOURCES)
    set_target_properties(bf_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
  foreach(used IN LISTS ARG_USES)
    # Headers only, and not passed on: each module names all that it includes.
    target_include_directories(bf_${name} ${scope} $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/modules/${used}>)
  endforeach()
endfunction()
