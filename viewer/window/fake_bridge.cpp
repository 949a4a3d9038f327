// Stands for the library of Looking Glass Bridge, with one display: what a test installs.

extern "C" {

bool initialize_bridge(const char* /*program*/) { return true; }
bool uninitialize_bridge() { return true; }

bool get_displays(int* count, unsigned long* numbers) {
  *count = 1;
  if (numbers != nullptr) numbers[0] = 3;
  return true;
}

bool get_ri_for_display(unsigned long display, int* index) {
  *index = 2;
  return display == 3;
}

bool get_calibration_for_display(unsigned long display, float* center, float* pitch, float* slope, int* width,
                                 int* height, float* dpi, float* flip_x, int* inverted_views, float* view_cone,
                                 float* fringe, int* cell_pattern, int* cell_count, void* /*cells*/) {
  *center = 0.25F;
  *pitch = 50.5F;
  *slope = -6.5F;
  *width = 320;
  *height = 200;
  *dpi = 128;
  *flip_x = 0;
  *inverted_views = 1;
  *view_cone = 40;
  *fringe = 0;
  *cell_pattern = *cell_count = 0;
  return display == 3;
}
}
