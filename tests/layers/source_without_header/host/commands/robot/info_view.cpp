void view_info() {}
