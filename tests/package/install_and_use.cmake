# Installs into an empty folder, builds examples/falling_cube against it and runs that; with -DOUTPUT=ON examples/recorded_wall
# and the installed command too.
include(${CMAKE_CURRENT_LIST_DIR}/must.cmake)

file(REMOVE_RECURSE ${WORK_DIR})
must(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
function(build_example name)
  must(${CMAKE_COMMAND} -S ${SOURCE_DIR}/examples/${name} -B ${WORK_DIR}/${name} -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
  must(${CMAKE_COMMAND} --build ${WORK_DIR}/${name})
endfunction()
build_example(falling_cube)
must(${WORK_DIR}/falling_cube/falling_cube)
if(NOT output MATCHES "at rest at height 0\\.[01]")
  message(FATAL_ERROR "the example ran, but said: ${output}")
endif()

# What else is put in place: documents with their index, examples, the schema.
foreach(file share/doc/brickfall/docs/README.md share/doc/brickfall/THIRD_PARTY.md
    share/doc/brickfall/examples/falling_cube/main.cpp share/brickfall/docs/scene.schema.json)
  if(NOT EXISTS ${WORK_DIR}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
find_program(PKG_CONFIG NAMES pkg-config pkgconf)
if(PKG_CONFIG)
  file(GLOB_RECURSE pc ${WORK_DIR}/prefix/brickfall.pc)
  get_filename_component(pc_dir ${pc} DIRECTORY)
  must(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_dir} ${PKG_CONFIG} --cflags --libs brickfall)
  string(REPLACE "\n" "" flags "${output}")
  separate_arguments(flags UNIX_COMMAND "${flags}")
  must(${CXX} -std=c++20 ${SOURCE_DIR}/examples/falling_cube/main.cpp -o ${WORK_DIR}/by_pkg_config ${flags})
  must(${WORK_DIR}/by_pkg_config)
endif()

if(NOT OUTPUT)
  return()
endif()
build_example(recorded_wall)
must(${WORK_DIR}/recorded_wall/recorded_wall ${WORK_DIR}/prefix/share/brickfall/scenes/wall_hit.toml ${WORK_DIR})
file(SIZE ${WORK_DIR}/wall.html page)
if(NOT output MATCHES "61 frames" OR page LESS 100000)
  message(FATAL_ERROR "the example ran, but made a page of ${page} bytes and said: ${output}")
endif()

# The installed command finds the installed scenes, not those of the source tree.
must(${CMAKE_COMMAND} -E env --unset=BRICKFALL_SCENES ${WORK_DIR}/prefix/bin/brickfall check wall)
if(NOT output MATCHES "prefix/.*wall\\.toml")
  message(FATAL_ERROR "checked another scene file than the installed one: ${output}")
endif()
