void add_info() {}
