# The exact packages of package-lock.json into the build folder: cmake -DNPM= -DFROM= -DTO= -P npm_ci.cmake
file(MAKE_DIRECTORY ${TO})
file(COPY ${FROM}/package.json ${FROM}/package-lock.json DESTINATION ${TO})
execute_process(COMMAND ${NPM} ci --no-audit --no-fund --loglevel=error WORKING_DIRECTORY ${TO}
  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(failed)
  message(FATAL_ERROR "npm could not install the replay page's packages (three.js, esbuild); the first build needs the "
    "network, or an npm cache. npm says:\n${output}")
endif()
file(TOUCH ${TO}/npm.stamp)
