#include "wheatstone/video/libav_functions_internal.h"

extern "C" {
#include <libavutil/log.h>
}

extern "C" const wheatstone::LibavFunctions* wheatstone_libav_functions() {
  static constexpr wheatstone::LibavFunctions functions;
  av_log_set_level(AV_LOG_QUIET);
  return &functions;
}
