#pragma once

// The functions of libav that films need. They are called through a table, which a module gives: libav's 90 libraries
// take a quarter of the start of a program that opens no film.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/cpu.h>
#include <libavutil/frame.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libavutil/timecode.h>
#include <libswscale/swscale.h>
}

#include <cstddef>

namespace wheatstone {

/// Each function under its own name. Only the module makes such a table: nothing else is linked with libav.
struct LibavFunctions {
  decltype(::av_color_primaries_from_name)* av_color_primaries_from_name = ::av_color_primaries_from_name;
  decltype(::av_color_primaries_name)* av_color_primaries_name = ::av_color_primaries_name;
  decltype(::av_color_range_name)* av_color_range_name = ::av_color_range_name;
  decltype(::av_color_space_from_name)* av_color_space_from_name = ::av_color_space_from_name;
  decltype(::av_color_space_name)* av_color_space_name = ::av_color_space_name;
  decltype(::av_color_transfer_from_name)* av_color_transfer_from_name = ::av_color_transfer_from_name;
  decltype(::av_color_transfer_name)* av_color_transfer_name = ::av_color_transfer_name;
  decltype(::av_compare_ts)* av_compare_ts = ::av_compare_ts;
  decltype(::av_d2q)* av_d2q = ::av_d2q;
  decltype(::av_dict_copy)* av_dict_copy = ::av_dict_copy;
  decltype(::av_dict_free)* av_dict_free = ::av_dict_free;
  decltype(::av_dict_get)* av_dict_get = ::av_dict_get;
  decltype(::av_dict_set)* av_dict_set = ::av_dict_set;
  decltype(::av_frame_alloc)* av_frame_alloc = ::av_frame_alloc;
  decltype(::av_frame_free)* av_frame_free = ::av_frame_free;
  decltype(::av_frame_get_buffer)* av_frame_get_buffer = ::av_frame_get_buffer;
  decltype(::av_frame_get_side_data)* av_frame_get_side_data = ::av_frame_get_side_data;
  decltype(::av_free)* av_free = ::av_free;
  decltype(::av_get_cpu_flags)* av_get_cpu_flags = ::av_get_cpu_flags;
  decltype(::av_get_pix_fmt)* av_get_pix_fmt = ::av_get_pix_fmt;
  decltype(::av_get_pix_fmt_name)* av_get_pix_fmt_name = ::av_get_pix_fmt_name;
  decltype(::av_guess_sample_aspect_ratio)* av_guess_sample_aspect_ratio = ::av_guess_sample_aspect_ratio;
  decltype(::av_interleaved_write_frame)* av_interleaved_write_frame = ::av_interleaved_write_frame;
  decltype(::av_malloc)* av_malloc = ::av_malloc;
  decltype(::av_mallocz)* av_mallocz = ::av_mallocz;
  decltype(::av_mul_q)* av_mul_q = ::av_mul_q;
  decltype(::av_opt_set)* av_opt_set = ::av_opt_set;
  decltype(::av_opt_set_double)* av_opt_set_double = ::av_opt_set_double;
  decltype(::av_opt_set_int)* av_opt_set_int = ::av_opt_set_int;
  decltype(::av_packet_alloc)* av_packet_alloc = ::av_packet_alloc;
  decltype(::av_packet_free)* av_packet_free = ::av_packet_free;
  decltype(::av_packet_rescale_ts)* av_packet_rescale_ts = ::av_packet_rescale_ts;
  decltype(::av_packet_unref)* av_packet_unref = ::av_packet_unref;
  decltype(::av_pix_fmt_desc_get)* av_pix_fmt_desc_get = ::av_pix_fmt_desc_get;
  decltype(::av_read_frame)* av_read_frame = ::av_read_frame;
  decltype(::av_rescale_q)* av_rescale_q = ::av_rescale_q;
  decltype(::av_seek_frame)* av_seek_frame = ::av_seek_frame;
  decltype(::av_stream_get_side_data)* av_stream_get_side_data = ::av_stream_get_side_data;
  decltype(::av_stream_new_side_data)* av_stream_new_side_data = ::av_stream_new_side_data;
  decltype(::av_strerror)* av_strerror = ::av_strerror;
  decltype(::av_timecode_init_from_string)* av_timecode_init_from_string = ::av_timecode_init_from_string;
  decltype(::av_timecode_make_string)* av_timecode_make_string = ::av_timecode_make_string;
  decltype(::av_write_trailer)* av_write_trailer = ::av_write_trailer;
  decltype(::avcodec_alloc_context3)* avcodec_alloc_context3 = ::avcodec_alloc_context3;
  decltype(::avcodec_find_decoder)* avcodec_find_decoder = ::avcodec_find_decoder;
  decltype(::avcodec_find_encoder_by_name)* avcodec_find_encoder_by_name = ::avcodec_find_encoder_by_name;
  decltype(::avcodec_flush_buffers)* avcodec_flush_buffers = ::avcodec_flush_buffers;
  decltype(::avcodec_free_context)* avcodec_free_context = ::avcodec_free_context;
  decltype(::avcodec_get_name)* avcodec_get_name = ::avcodec_get_name;
  decltype(::avcodec_open2)* avcodec_open2 = ::avcodec_open2;
  decltype(::avcodec_parameters_alloc)* avcodec_parameters_alloc = ::avcodec_parameters_alloc;
  decltype(::avcodec_parameters_copy)* avcodec_parameters_copy = ::avcodec_parameters_copy;
  decltype(::avcodec_parameters_free)* avcodec_parameters_free = ::avcodec_parameters_free;
  decltype(::avcodec_parameters_from_context)* avcodec_parameters_from_context = ::avcodec_parameters_from_context;
  decltype(::avcodec_parameters_to_context)* avcodec_parameters_to_context = ::avcodec_parameters_to_context;
  decltype(::avcodec_receive_frame)* avcodec_receive_frame = ::avcodec_receive_frame;
  decltype(::avcodec_receive_packet)* avcodec_receive_packet = ::avcodec_receive_packet;
  decltype(::avcodec_send_frame)* avcodec_send_frame = ::avcodec_send_frame;
  decltype(::avcodec_send_packet)* avcodec_send_packet = ::avcodec_send_packet;
  decltype(::avcodec_version)* avcodec_version = ::avcodec_version;
  decltype(::avformat_alloc_output_context2)* avformat_alloc_output_context2 = ::avformat_alloc_output_context2;
  decltype(::avformat_close_input)* avformat_close_input = ::avformat_close_input;
  decltype(::avformat_find_stream_info)* avformat_find_stream_info = ::avformat_find_stream_info;
  decltype(::avformat_free_context)* avformat_free_context = ::avformat_free_context;
  decltype(::avformat_new_stream)* avformat_new_stream = ::avformat_new_stream;
  decltype(::avformat_open_input)* avformat_open_input = ::avformat_open_input;
  decltype(::avformat_query_codec)* avformat_query_codec = ::avformat_query_codec;
  decltype(::avformat_write_header)* avformat_write_header = ::avformat_write_header;
  decltype(::avio_close_dyn_buf)* avio_close_dyn_buf = ::avio_close_dyn_buf;
  decltype(::avio_closep)* avio_closep = ::avio_closep;
  decltype(::avio_open)* avio_open = ::avio_open;
  decltype(::avio_open_dyn_buf)* avio_open_dyn_buf = ::avio_open_dyn_buf;
  decltype(::sws_alloc_context)* sws_alloc_context = ::sws_alloc_context;
  decltype(::sws_freeContext)* sws_freeContext = ::sws_freeContext;
  decltype(::sws_getCoefficients)* sws_getCoefficients = ::sws_getCoefficients;
  decltype(::sws_init_context)* sws_init_context = ::sws_init_context;
  decltype(::sws_scale)* sws_scale = ::sws_scale;
  decltype(::sws_setColorspaceDetails)* sws_setColorspaceDetails = ::sws_setColorspaceDetails;
};

/// The module's function that gives the others.
using GiveLibav = const LibavFunctions*();
inline constexpr auto libav_module_name = "wheatstone_libav";
inline constexpr std::size_t libav_module_bytes = std::size_t{192} << 20;
inline constexpr auto give_libav_name = "wheatstone_libav_functions";

/// The functions of libav, which is loaded at the first call and does not write to the terminal: what matters comes as
/// an Error. Throws as function_of_module.
const LibavFunctions& libav();

}  // namespace wheatstone
