#include "wheatstone/video/deinterlacer_internal.h"

#include <cstdio>
#include <memory>
#include <string>

extern "C" {
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
}

namespace wheatstone {
namespace {

class Bwdif : public Deinterlacer {
 public:
  ~Bwdif() override { avfilter_graph_free(&graph_); }

  bool open(const AVFrame& first, AVRational time_base, int threads) {
    graph_ = avfilter_graph_alloc();
    if (graph_ == nullptr) return false;
    graph_->nb_threads = threads;
    char source[256];
    const AVRational aspect = first.sample_aspect_ratio.den > 0 ? first.sample_aspect_ratio : AVRational{0, 1};
    std::snprintf(source, sizeof(source), "video_size=%dx%d:pix_fmt=%d:time_base=%d/%d:pixel_aspect=%d/%d", first.width,
                  first.height, first.format, time_base.num, time_base.den, aspect.num, aspect.den);
    AVFilterContext* filter = nullptr;
    return create(source_, "buffer", source) &&
           create(filter, "bwdif", "mode=send_frame:parity=auto:deint=interlaced") && create(sink_, "buffersink", "") &&
           avfilter_link(source_, 0, filter, 0) >= 0 && avfilter_link(filter, 0, sink_, 0) >= 0 &&
           avfilter_graph_config(graph_, nullptr) >= 0;
  }

  int send(const AVFrame* frame) override {
    if (frame == nullptr) return av_buffersrc_add_frame_flags(source_, nullptr, 0);
    return av_buffersrc_add_frame_flags(source_, const_cast<AVFrame*>(frame), AV_BUFFERSRC_FLAG_KEEP_REF);
  }

  int receive(AVFrame& frame) override {
    av_frame_unref(&frame);
    return av_buffersink_get_frame(sink_, &frame);
  }

 private:
  bool create(AVFilterContext*& filter, const char* name, const char* options) {
    return avfilter_graph_create_filter(&filter, avfilter_get_by_name(name), name, options, nullptr, graph_) >= 0;
  }

  AVFilterGraph* graph_ = nullptr;
  AVFilterContext* source_ = nullptr;
  AVFilterContext* sink_ = nullptr;
};

}  // namespace
}  // namespace wheatstone

extern "C" wheatstone::Deinterlacer* wheatstone_open_deinterlacer(const AVFrame& first, AVRational time_base,
                                                                  int threads) {
  auto bwdif = std::make_unique<wheatstone::Bwdif>();
  return bwdif->open(first, time_base, threads) ? bwdif.release() : nullptr;
}
