// Texts in rows and columns, with a caption; cells of the column "verdict" are badges.
export default {
  template: `
    <table>
      <caption v-if="shown.title">{{ shown.title }}</caption>
      <thead>
        <tr>
          <th v-for="column in shown.columns" :key="column.name" :class="column.align" scope="col">{{ column.label }}</th>
        </tr>
      </thead>
      <tbody>
        <tr v-for="(row, number) in shown.rows" :key="number">
          <td v-for="column in shown.columns" :key="column.name" :class="column.align">
            <span v-if="column.name === 'verdict'" class="badge" :class="row.verdict">{{ row.verdict }}</span>
            <template v-else>{{ row[column.name] }}</template>
          </td>
        </tr>
      </tbody>
    </table>`,
  props: { content: Object },
  data() {
    return { shown: this.content };
  },
  watch: {
    content(content) {
      this.shown = content;
    },
  },
  mounted() {
    this.$emit("drawn");
  },
  methods: {
    show(content) {
      this.shown = Object.freeze(content); // frozen: Vue need not watch every cell
    },
  },
};
